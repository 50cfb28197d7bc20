#include "tests/transfer/random_case.hpp"

#include <algorithm>
#include <numeric>

#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"

namespace vocalis::transfer {

namespace {

double middle(const mesh::WholeMesh& mesh, std::int64_t cell, int axis) {
  double sum = 0;
  for (int i = 0; i <= mesh.dimension; ++i) {
    sum += mesh.coordinates[mesh.cell_vertices[cell * (mesh.dimension + 1) + i] * mesh.dimension + axis];
  }
  return sum / (mesh.dimension + 1);
}

/// Gives edges of some cells a middle somewhere near. Cells that share one may name it twice, with the same point.
void bend_some_edges(Random& random, mesh::WholeMesh& mesh) {
  const int d = mesh.dimension;
  if (draw(random, 2) == 0) return;
  for (std::int64_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (draw(random, 4) != 0) continue;
    const std::int64_t* ends = mesh.cell_vertices.data() + cell * (d + 1);
    mesh.curved_edges.insert(mesh.curved_edges.end(), ends, ends + 2);
    for (int k = 0; k < d; ++k) {
      mesh.curved_points.push_back(0.1 + 0.5 * (mesh.coordinates[ends[0] * d + k] + mesh.coordinates[ends[1] * d + k]));
    }
  }
}

mesh::WholeMesh shuffled_box(Random& random) {
  const bool solid = draw(random, 3) == 0;
  const int most = solid ? 2 : 4;
  const auto count = [&] { return static_cast<int>(1 + draw(random, most)); };
  mesh::WholeMesh box = mesh::box(MPI_COMM_SELF, {1, 1, solid ? 1.0 : 0.0}, {count(), count(), count()});
  const int corners = box.dimension + 1;
  std::vector<std::int64_t> order(box.num_cells());
  std::iota(order.begin(), order.end(), 0);
  for (std::int64_t i = box.num_cells() - 1; i > 0; --i) std::swap(order[i], order[draw(random, i + 1)]);
  std::vector<std::int64_t> vertices;
  for (const std::int64_t cell : order) {
    const auto first = box.cell_vertices.begin() + cell * corners;
    vertices.insert(vertices.end(), first, first + corners);
  }
  box.cell_vertices = vertices;
  box.region_names = {"air", "fluid", "fold"};
  for (auto& region : box.cell_region) region = static_cast<std::int32_t>(draw(random, 3));
  box.group_names.push_back("marked");
  for (std::int64_t cell = 0; cell < box.num_cells(); ++cell) {
    if (draw(random, 4) != 0) continue;
    // The facet opposite to the cell's last vertex; neighbours may name it twice, which is a group listed twice.
    const auto first = box.cell_vertices.begin() + cell * corners;
    box.facet_vertices.insert(box.facet_vertices.end(), first, first + box.dimension);
    box.facet_group.push_back(static_cast<std::int32_t>(box.group_names.size()) - 1);
  }
  bend_some_edges(random, box);
  return box;
}

}  // namespace

std::int64_t draw(Random& random, std::int64_t below) {
  return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(below));
}

RandomCase random_case(Random& random, int ranks) {
  RandomCase result;
  result.whole = shuffled_box(random);
  const std::int64_t way = draw(random, 5);
  const int axis = static_cast<int>(draw(random, result.whole.dimension));
  const std::int64_t only = draw(random, ranks);
  result.cells_of_rank.resize(ranks);
  for (std::int64_t cell = 0; cell < result.whole.num_cells(); ++cell) {
    std::int64_t rank = draw(random, ranks);
    if (way == 0) rank = only;
    if (way == 1)
      rank = std::min<std::int64_t>(ranks - 1, static_cast<std::int64_t>(middle(result.whole, cell, axis) * ranks));
    result.cell_rank.push_back(static_cast<std::int32_t>(rank));
    result.cells_of_rank[rank].push_back(cell);
  }
  return result;
}

mesh::Mesh RandomCase::distribute(MPI_Comm comm) const {
  mesh::WholeMesh mine;
  if (base::rank(comm) == 0) mine = whole;
  return mesh::build_mesh(comm, mesh::scatter(comm, mine, cell_rank));
}

std::vector<std::int32_t> random_mask(Random& random, const RandomCase& on) {
  const std::int64_t cells = on.whole.num_cells(), way = draw(random, 8), single = draw(random, cells);
  const std::int64_t chance = 1 + draw(random, 9), axis = draw(random, on.whole.dimension);
  std::vector<std::int32_t> empty_rank;
  for (std::size_t r = 0; r < on.cells_of_rank.size(); ++r) empty_rank.push_back(draw(random, 3) == 0);
  std::vector<std::int32_t> mask;
  for (std::int64_t cell = 0; cell < cells; ++cell) {
    bool keep = draw(random, 10) < chance;
    if (way == 0) keep = false;
    if (way == 1) keep = true;
    if (way == 2) keep = cell == single;
    if (way == 3) keep = middle(on.whole, cell, static_cast<int>(axis)) < 0.5;
    if (way == 4 && empty_rank[on.cell_rank[cell]]) keep = false;
    mask.push_back(keep);
  }
  return mask;
}

std::vector<std::int32_t> mask_of_rank(const RandomCase& on, const std::vector<std::int32_t>& mask, int rank) {
  std::vector<std::int32_t> result;
  for (const std::int64_t cell : on.cells_of_rank[rank]) result.push_back(mask[cell]);
  return result;
}

}  // namespace vocalis::transfer
