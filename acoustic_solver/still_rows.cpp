#include "acoustic_solver/still_rows.hpp"

#include <algorithm>
#include <numeric>

#include "acoustic_solver/row_order.hpp"
#include "core/base/mpi.hpp"
#include "core/la/assembled_matrix.hpp"

namespace vocalis::acoustic {

namespace {

/// Entries beside the diagonal, rows in the order of the owned vertices, columns global.
struct GlobalRows {
  std::vector<std::int32_t> starts = {0};
  std::vector<PetscInt> columns;
  std::vector<double> values;
};

GlobalRows read_rows(Mat matrix) {
  GlobalRows rows;
  PetscInt first = 0, end = 0;
  base::check(MatGetOwnershipRange(matrix, &first, &end));
  for (PetscInt row = first; row < end; ++row) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    base::check(MatGetRow(matrix, row, &count, &columns, &values));
    for (PetscInt k = 0; k < count; ++k) {
      if (columns[k] == row) continue;
      rows.columns.push_back(columns[k]);
      rows.values.push_back(values[k]);
    }
    base::check(MatRestoreRow(matrix, row, &count, &columns, &values));
    rows.starts.push_back(static_cast<std::int32_t>(rows.columns.size()));
  }
  return rows;
}

/// (cells, n, n) values of the stiffness, or of the mass.
std::vector<double> cell_values(const mesh::Mesh& mesh, const WaveOperator& wave, bool is_mass) {
  const int d = mesh.dimension, n = d + 1;
  std::vector<double> values(static_cast<std::size_t>(mesh.num_cells()) * n * n);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    double* entry = values.data() + static_cast<std::size_t>(cell) * n * n;
    const double mass = wave.inverse_bulk_modulus() * wave.measure(cell) / (n * (n + 1));
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double* g = wave.gradient(cell, i);
        const double product = std::inner_product(g, g + d, wave.gradient(cell, j), 0.0);
        entry[i * n + j] = is_mass ? (i == j ? 2 : 1) * mass : wave.measure(cell) * product;
      }
    }
  }
  return values;
}

/// Global columns become local: owned vertices, then ghosts, which go into the map by their global numbers.
std::vector<std::int32_t> local_columns(const GlobalRows& rows, const base::IndexMap& owned, base::IndexMap& map) {
  const std::vector<std::int64_t> offsets = base::gather_all(owned.comm, owned.offset);
  map.comm = owned.comm;
  map.num_owned = owned.num_owned;
  map.offset = owned.offset;
  map.num_global = owned.num_global;
  const auto is_owned = [&](std::int64_t g) { return g >= owned.offset && g < owned.offset + owned.num_owned; };
  for (const PetscInt column : rows.columns) {
    if (!is_owned(column)) map.ghost_global.push_back(column);
  }
  auto& ghosts = map.ghost_global;
  std::sort(ghosts.begin(), ghosts.end());
  ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
  for (const std::int64_t ghost : ghosts) {
    const auto after = std::upper_bound(offsets.begin(), offsets.end(), ghost);
    map.ghost_owner.push_back(static_cast<int>(after - offsets.begin()) - 1);
  }
  std::vector<std::int32_t> columns;
  columns.reserve(rows.columns.size());
  for (const PetscInt column : rows.columns) {
    const auto found = std::lower_bound(ghosts.begin(), ghosts.end(), column) - ghosts.begin();
    columns.push_back(static_cast<std::int32_t>(is_owned(column) ? column - owned.offset : owned.num_owned + found));
  }
  return columns;
}

}  // namespace

StillRows assemble_still_rows(const mesh::Mesh& mesh, const fem::Space& space, const WaveOperator& wave) {
  const la::SystemLayout layout(mesh.comm, {{&space.dofs, 1}});
  std::vector<PetscInt> rows_of_cell;
  for (const std::int32_t dof : space.cell_dofs) rows_of_cell.push_back(layout.global(0, dof, 0));
  la::AssembledMatrix matrix(layout, rows_of_cell, space.dofs_per_cell, {});
  matrix.assemble(cell_values(mesh, wave, false));
  const GlobalRows stiffness = read_rows(matrix.get());
  matrix.assemble(cell_values(mesh, wave, true));
  const GlobalRows mass = read_rows(matrix.get());

  StillRows rows;
  const std::vector<std::int32_t> columns = local_columns(stiffness, space.dofs, rows.map);
  const std::int32_t n = space.dofs.num_owned;
  rows.vertex = reverse_cuthill_mckee(stiffness.starts, columns);
  const auto is_inner = [&](std::int32_t v) {
    return std::all_of(columns.begin() + stiffness.starts[v], columns.begin() + stiffness.starts[v + 1],
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
    for (std::int32_t k = stiffness.starts[v]; k < stiffness.starts[v + 1]; ++k) {
      const std::int32_t column = columns[k];
      rows.columns.push_back(column < n ? static_cast<std::int32_t>(row_of[column] - rows.map.offset) : column);
      rows.stiffness.push_back(stiffness.values[k]);
      rows.mass.push_back(mass.values[k]);
    }
    rows.starts.push_back(static_cast<std::int32_t>(rows.columns.size()));
  }
  return rows;
}

}  // namespace vocalis::acoustic
