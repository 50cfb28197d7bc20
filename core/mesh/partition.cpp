#include "core/mesh/partition.hpp"

#include <metis.h>

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

#include "core/base/mpi.hpp"

namespace vocalis::mesh {

namespace {

static_assert(sizeof(idx_t) == sizeof(std::int32_t), "METIS is built with 32-bit indices");

/// What rank 0 sends to one rank, as two flat lists.
struct Parcel {
  std::unordered_map<std::int64_t, std::int64_t> whole_to_part;
  std::vector<std::int64_t> vertex_input, cell_vertices, cell_region, facet_vertices, facet_group, curved_edges;
  std::vector<double> curved_points;

  std::int64_t vertex(std::int64_t whole) {
    const auto [entry, is_new] = whole_to_part.try_emplace(whole, static_cast<std::int64_t>(vertex_input.size()));
    if (is_new) vertex_input.push_back(whole);
    return entry->second;
  }
};

std::vector<Parcel> pack(const WholeMesh& mesh, const std::vector<std::int32_t>& cell_rank, int ranks) {
  std::vector<Parcel> parcels(ranks);
  const int d = mesh.dimension;
  for (std::int64_t cell = 0; cell < mesh.num_cells(); ++cell) {
    Parcel& parcel = parcels[cell_rank[cell]];
    for (int i = 0; i <= d; ++i) parcel.cell_vertices.push_back(parcel.vertex(mesh.cell_vertices[cell * (d + 1) + i]));
    parcel.cell_region.push_back(mesh.cell_region[cell]);
  }
  for (std::size_t facet = 0; facet < mesh.facet_group.size(); ++facet) {
    for (Parcel& parcel : parcels) {
      const auto* corners = mesh.facet_vertices.data() + facet * d;
      const bool here = std::all_of(corners, corners + d, [&](auto v) { return parcel.whole_to_part.contains(v); });
      if (!here) continue;
      for (int i = 0; i < d; ++i) parcel.facet_vertices.push_back(parcel.whole_to_part.at(corners[i]));
      parcel.facet_group.push_back(mesh.facet_group[facet]);
    }
  }
  for (std::size_t edge = 0; 2 * edge < mesh.curved_edges.size(); ++edge) {
    const std::int64_t* ends = mesh.curved_edges.data() + 2 * edge;
    for (Parcel& parcel : parcels) {
      if (!parcel.whole_to_part.contains(ends[0]) || !parcel.whole_to_part.contains(ends[1])) continue;
      for (int i = 0; i < 2; ++i) parcel.curved_edges.push_back(parcel.whole_to_part.at(ends[i]));
      const auto point = mesh.curved_points.begin() + static_cast<std::ptrdiff_t>(edge) * d;
      parcel.curved_points.insert(parcel.curved_points.end(), point, point + d);
    }
  }
  return parcels;
}

/// Gives each rank its own list out of rank 0's. Collective.
template <class T>
std::vector<T> deal(MPI_Comm comm, std::vector<std::vector<T>> lists) {
  lists.resize(base::size(comm));
  return base::exchange(comm, lists)[0];
}

std::vector<std::int32_t> narrow(const std::vector<std::int64_t>& values) { return {values.begin(), values.end()}; }

}  // namespace

std::vector<std::string> broadcast_names(MPI_Comm comm, const std::vector<std::string>& names) {
  std::vector<char> text;  // the names, each ended by a zero: one broadcast carries them all
  for (const std::string& name : names) {
    text.insert(text.end(), name.begin(), name.end());
    text.push_back('\0');
  }
  base::broadcast(comm, text);
  std::vector<std::string> result;
  for (auto start = text.begin(); start != text.end();) {
    const auto end = std::find(start, text.end(), '\0');
    result.emplace_back(start, end);
    start = end + 1;
  }
  return result;
}

std::vector<std::int32_t> partition_cells(const WholeMesh& mesh, int ranks, const std::vector<std::int32_t>& work,
                                          int constraints) {
  std::vector<std::int32_t> cell_rank(mesh.num_cells(), 0);
  if (ranks == 1 || mesh.num_cells() <= ranks) {
    for (std::int64_t cell = 0; cell < mesh.num_cells(); ++cell)
      cell_rank[cell] = static_cast<std::int32_t>(cell % ranks);
    return cell_rank;
  }
  idx_t num_cells = static_cast<idx_t>(mesh.num_cells());
  idx_t num_vertices = static_cast<idx_t>(mesh.coordinates.size() / mesh.dimension);
  std::vector<idx_t> starts(num_cells + 1), vertices(mesh.cell_vertices.begin(), mesh.cell_vertices.end());
  for (idx_t cell = 0; cell <= num_cells; ++cell) starts[cell] = cell * (mesh.dimension + 1);
  idx_t common = mesh.dimension, numbering = 0;
  idx_t *graph_starts = nullptr, *graph = nullptr;
  if (METIS_MeshToDual(&num_cells, &num_vertices, starts.data(), vertices.data(), &common, &numbering, &graph_starts,
                       &graph) != METIS_OK) {
    throw std::runtime_error("METIS could not make the graph of cells");
  }
  idx_t weights = constraints, parts = ranks, cut = 0;
  std::vector<idx_t> weight(work.begin(), work.end());
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  const int code = METIS_PartGraphKway(&num_cells, &weights, graph_starts, graph, weight.data(), nullptr, nullptr,
                                       &parts, nullptr, nullptr, options, &cut, cell_rank.data());
  METIS_Free(graph_starts);
  METIS_Free(graph);
  if (code != METIS_OK) throw std::runtime_error("METIS could not partition the mesh");
  return cell_rank;
}

MeshPart scatter(MPI_Comm comm, const WholeMesh& mesh, const std::vector<std::int32_t>& cell_rank) {
  const int ranks = base::size(comm);
  std::vector<Parcel> parcels;
  if (base::rank(comm) == 0) parcels = pack(mesh, cell_rank, ranks);
  std::vector<std::int32_t> dimension = {mesh.dimension};
  base::broadcast(comm, dimension);

  MeshPart part;
  part.dimension = dimension[0];
  part.region_names = broadcast_names(comm, mesh.region_names);
  part.group_names = broadcast_names(comm, mesh.group_names);
  std::vector<std::vector<std::int64_t>> inputs, cells, regions, facets, groups, curved_edges;
  std::vector<std::vector<double>> points, curved_points;
  for (Parcel& parcel : parcels) {
    auto& point = points.emplace_back();
    for (const std::int64_t v : parcel.vertex_input) {
      const auto first = mesh.coordinates.begin() + v * mesh.dimension;
      point.insert(point.end(), first, first + mesh.dimension);
    }
    inputs.push_back(std::move(parcel.vertex_input));
    cells.push_back(std::move(parcel.cell_vertices));
    regions.push_back(std::move(parcel.cell_region));
    facets.push_back(std::move(parcel.facet_vertices));
    groups.push_back(std::move(parcel.facet_group));
    curved_edges.push_back(std::move(parcel.curved_edges));
    curved_points.push_back(std::move(parcel.curved_points));
  }
  part.vertex_input = deal(comm, std::move(inputs));
  part.coordinates = deal(comm, std::move(points));
  part.cell_vertices = narrow(deal(comm, std::move(cells)));
  part.cell_region = narrow(deal(comm, std::move(regions)));
  part.facet_vertices = narrow(deal(comm, std::move(facets)));
  part.facet_group = narrow(deal(comm, std::move(groups)));
  part.curved_edges = narrow(deal(comm, std::move(curved_edges)));
  part.curved_points = deal(comm, std::move(curved_points));
  return part;
}

Mesh distribute(MPI_Comm comm, const WholeMesh& mesh) {
  std::vector<std::int32_t> cell_rank;
  if (base::rank(comm) == 0) {
    cell_rank = partition_cells(mesh, base::size(comm), std::vector<std::int32_t>(mesh.num_cells(), 1), 1);
  }
  return build_mesh(comm, scatter(comm, mesh, cell_rank));
}

}  // namespace vocalis::mesh
