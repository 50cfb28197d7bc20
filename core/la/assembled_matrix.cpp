#include "core/la/assembled_matrix.hpp"

#include <algorithm>
#include <cassert>

namespace vocalis::la {

namespace {

/// Values of a distributed vector at any global rows. Collective.
std::vector<double> gather_rows(Vec vector, const std::vector<PetscInt>& rows) {
  PetscVector here;
  base::check(VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(rows.size()), here.put()));
  Owner<IS, ISDestroy> from;
  base::check(
      ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(rows.size()), rows.data(), PETSC_COPY_VALUES, from.put()));
  Owner<VecScatter, VecScatterDestroy> scatter;
  base::check(VecScatterCreate(vector, from.get(), here.get(), nullptr, scatter.put()));
  base::check(VecScatterBegin(scatter.get(), vector, here.get(), INSERT_VALUES, SCATTER_FORWARD));
  base::check(VecScatterEnd(scatter.get(), vector, here.get(), INSERT_VALUES, SCATTER_FORWARD));
  const ReadValues values(here.get());
  return {values.data(), values.data() + rows.size()};
}

}  // namespace

std::vector<char> is_constrained(const SystemLayout& layout, std::span<const PetscInt> rows,
                                 std::span<const PetscInt> constrained) {
  const PetscVector marker = create_vector(layout.comm(), layout.num_owned());
  {
    const OwnedValues values(marker.get());
    for (const PetscInt position : constrained) values[position] = 1;
  }
  std::vector<PetscInt> distinct(rows.begin(), rows.end());
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  if (!distinct.empty() && distinct.front() < 0) distinct.erase(distinct.begin());
  const std::vector<double> marks = gather_rows(marker.get(), distinct);
  std::vector<char> result(rows.size(), 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] < 0) continue;
    const auto found = std::lower_bound(distinct.begin(), distinct.end(), rows[i]);
    result[i] = marks[found - distinct.begin()] != 0;
  }
  return result;
}

AssembledMatrix::AssembledMatrix(const SystemLayout& layout, std::span<const PetscInt> rows_of_cell, int n,
                                 std::span<const PetscInt> constrained, bool drop_columns) {
  const std::vector<char> dropped = is_constrained(layout, rows_of_cell, constrained);
  const std::size_t num_cells = rows_of_cell.size() / n;
  num_cell_values_ = num_cells * n * n;
  std::vector<PetscInt> rows, columns;
  rows.reserve(num_cell_values_ + constrained.size());
  columns.reserve(num_cell_values_ + constrained.size());
  for (std::size_t cell = 0; cell < num_cells; ++cell) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const bool keep = !dropped[cell * n + i] && !(drop_columns && dropped[cell * n + j]);
        rows.push_back(keep ? rows_of_cell[cell * n + i] : -1);
        columns.push_back(keep ? rows_of_cell[cell * n + j] : -1);
      }
    }
  }
  for (const PetscInt position : constrained) {
    rows.push_back(layout.offset() + position);
    columns.push_back(layout.offset() + position);
  }
  all_values_.assign(rows.size(), 0.0);
  std::fill(all_values_.begin() + num_cell_values_, all_values_.end(), 1.0);
  base::check(MatCreate(layout.comm(), matrix_.put()));
  base::check(MatSetSizes(matrix_.get(), layout.num_owned(), layout.num_owned(), PETSC_DETERMINE, PETSC_DETERMINE));
  base::check(MatSetType(matrix_.get(), MATAIJ));
  base::check(MatSetPreallocationCOO(matrix_.get(), static_cast<PetscCount>(rows.size()), rows.data(), columns.data()));
  base::check(MatSetValuesCOO(matrix_.get(), all_values_.data(), INSERT_VALUES));  // so that its rows can be read
}

void AssembledMatrix::assemble(std::span<const double> values) {
  assert(values.size() == num_cell_values_);
  std::copy(values.begin(), values.end(), all_values_.begin());
  base::check(MatSetValuesCOO(matrix_.get(), all_values_.data(), INSERT_VALUES));
}

}  // namespace vocalis::la
