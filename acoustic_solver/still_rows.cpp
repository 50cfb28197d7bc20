#include "acoustic_solver/still_rows.hpp"

#include <algorithm>
#include <numeric>

#include "acoustic_solver/row_order.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::acoustic {

namespace {

/// An entry beside the diagonal, of a row of this rank.
struct Entry {
  std::int64_t row, column;  ///< local row, global column
  double stiffness, mass;
};

/// Sorts by row and column and adds up what belongs together.
void merge(std::vector<Entry>& entries) {
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return std::pair(a.row, a.column) < std::pair(b.row, b.column); });
  std::size_t count = 0;
  for (const Entry& entry : entries) {
    if (count > 0 && entries[count - 1].row == entry.row && entries[count - 1].column == entry.column) {
      entries[count - 1].stiffness += entry.stiffness;
      entries[count - 1].mass += entry.mass;
    } else {
      entries[count++] = entry;
    }
  }
  entries.resize(count);
}

/// What this rank's cells add to the rows of its owned and ghost vertices, vertex by vertex.
std::vector<Entry> entries_of_cells(const mesh::Mesh& mesh, const WaveOperator& wave) {
  const int d = mesh.dimension, n = d + 1;
  std::vector<std::int32_t> starts(mesh.num_vertices() + 1, 0), cells(mesh.cell_vertices.size());
  for (const std::int32_t v : mesh.cell_vertices) ++starts[v + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<std::int32_t> next(starts.begin(), starts.end() - 1);
  for (std::size_t k = 0; k < mesh.cell_vertices.size(); ++k) {
    cells[next[mesh.cell_vertices[k]]++] = static_cast<std::int32_t>(k / n);
  }
  std::vector<Entry> all, here;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    here.clear();
    for (std::int32_t k = starts[v]; k < starts[v + 1]; ++k) {
      const std::int32_t cell = cells[k];
      const auto vertices = mesh.vertices_of(cell);
      const int i = static_cast<int>(std::find(vertices.begin(), vertices.end(), v) - vertices.begin());
      for (int j = 0; j < n; ++j) {
        if (j == i) continue;
        const double* g = wave.gradient(cell, i);
        const double product = std::inner_product(g, g + d, wave.gradient(cell, j), 0.0);
        here.push_back({v, mesh.vertices.to_global(vertices[j]), wave.measure(cell) * product,
                        wave.inverse_bulk_modulus() * wave.measure(cell) / (n * (n + 1))});
      }
    }
    merge(here);
    all.insert(all.end(), here.begin(), here.end());
  }
  return all;
}

/// Sends the entries of ghosts to their owners and returns those of the owned rows, sorted. Collective.
std::vector<Entry> entries_of_owned(const mesh::Mesh& mesh, const WaveOperator& wave) {
  const int ranks = base::size(mesh.comm);
  std::vector<Entry> entries = entries_of_cells(mesh, wave);
  std::vector<std::vector<std::int64_t>> places(ranks);
  std::vector<std::vector<double>> values(ranks);
  for (const Entry& entry : entries) {
    if (entry.row < mesh.vertices.num_owned) continue;
    const int owner = mesh.vertices.ghost_owner[entry.row - mesh.vertices.num_owned];
    const std::int64_t row = mesh.vertices.to_global(static_cast<std::int32_t>(entry.row));
    places[owner].insert(places[owner].end(), {row, entry.column});
    values[owner].insert(values[owner].end(), {entry.stiffness, entry.mass});
  }
  std::erase_if(entries, [&](const Entry& entry) { return entry.row >= mesh.vertices.num_owned; });
  const auto received = base::exchange(mesh.comm, places);
  const auto numbers = base::exchange(mesh.comm, values);
  bool is_complete = true;
  for (int r = 0; r < ranks; ++r) {
    for (std::size_t k = 0; k < received[r].size(); k += 2) {
      entries.push_back({received[r][k] - mesh.vertices.offset, received[r][k + 1], numbers[r][k], numbers[r][k + 1]});
      is_complete = false;
    }
  }
  if (!is_complete) merge(entries);
  return entries;
}

/// Global columns become local: owned vertices, then ghosts, which go into the map by their global numbers.
std::vector<std::int32_t> local_columns(const std::vector<Entry>& entries, const base::IndexMap& owned,
                                        base::IndexMap& map) {
  const std::vector<std::int64_t> offsets = base::gather_all(owned.comm, owned.offset);
  map.comm = owned.comm;
  map.num_owned = owned.num_owned;
  map.offset = owned.offset;
  map.num_global = owned.num_global;
  const auto is_owned = [&](std::int64_t g) { return g >= owned.offset && g < owned.offset + owned.num_owned; };
  for (const Entry& entry : entries) {
    if (!is_owned(entry.column)) map.ghost_global.push_back(entry.column);
  }
  auto& ghosts = map.ghost_global;
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  for (const std::int64_t ghost : ghosts) {
    const auto after = std::upper_bound(offsets.begin(), offsets.end(), ghost);
    map.ghost_owner.push_back(static_cast<int>(after - offsets.begin()) - 1);
  }
  std::vector<std::int32_t> columns;
  columns.reserve(entries.size());
  for (const auto& [row, column, stiffness, mass] : entries) {
    const auto found = std::lower_bound(ghosts.begin(), ghosts.end(), column) - ghosts.begin();
    columns.push_back(static_cast<std::int32_t>(is_owned(column) ? column - owned.offset : owned.num_owned + found));
  }
  return columns;
}

}  // namespace

StillRows assemble_still_rows(const mesh::Mesh& mesh, const WaveOperator& wave) {
  const std::vector<Entry> entries = entries_of_owned(mesh, wave);
  const std::int32_t n = mesh.vertices.num_owned;
  StillRows rows;
  const std::vector<std::int32_t> columns = local_columns(entries, mesh.vertices, rows.map);
  std::vector<std::int32_t> starts(n + 1, 0);
  for (const Entry& entry : entries) ++starts[entry.row + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  rows.vertex = reverse_cuthill_mckee(starts, columns);
  const auto is_inner = [&](std::int32_t v) {
    return std::all_of(columns.begin() + starts[v], columns.begin() + starts[v + 1],
                       [n](std::int32_t column) { return column < n; });
  };
  const auto outer = std::stable_partition(rows.vertex.begin(), rows.vertex.end(), is_inner);
  rows.num_inner = static_cast<std::int32_t>(outer - rows.vertex.begin());

  // A ghost's number is its row where it is owned.
  std::vector<std::int64_t> row_of(n + rows.map.num_ghosts());
  for (std::int32_t row = 0; row < n; ++row) row_of[rows.vertex[row]] = rows.map.offset + row;
  base::Halo(rows.map).copy_to_ghosts(row_of);
  std::copy(row_of.begin() + n, row_of.end(), rows.map.ghost_global.begin());
  rows.halo = base::Halo(rows.map);

  rows.starts.push_back(0);
  for (const std::int32_t v : rows.vertex) {
    for (std::int32_t k = starts[v]; k < starts[v + 1]; ++k) {
      const std::int32_t column = columns[k];
      rows.columns.push_back(column < n ? static_cast<std::int32_t>(row_of[column] - rows.map.offset) : column);
      rows.stiffness.push_back(entries[k].stiffness);
      rows.mass.push_back(entries[k].mass);
    }
    rows.starts.push_back(static_cast<std::int32_t>(rows.columns.size()));
  }
  return rows;
}

}  // namespace vocalis::acoustic
