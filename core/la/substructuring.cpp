#include "core/la/substructuring.hpp"

#include <petscblaslapack.h>

#include <algorithm>

#include "core/base/mpi.hpp"

namespace vocalis::la {

namespace {

void destroy(Mat* copy) { MatDestroySubMatrices(1, &copy); }

std::vector<int> positions(const std::vector<PetscInt>& rows, const std::vector<PetscInt>& among) {
  std::vector<int> result;
  for (const PetscInt row : rows) {
    result.push_back(static_cast<int>(std::lower_bound(among.begin(), among.end(), row) - among.begin()));
  }
  return result;
}

/// The values of a sequential matrix, for as long as the object lives.
class Entries {
 public:
  explicit Entries(Mat matrix) : matrix_(matrix) { base::check(MatSeqAIJGetArrayRead(matrix, &values_)); }
  ~Entries() { MatSeqAIJRestoreArrayRead(matrix_, &values_); }
  Entries(const Entries&) = delete;
  Entries& operator=(const Entries&) = delete;
  double operator[](std::size_t i) const { return values_[i]; }

 private:
  Mat matrix_;
  const double* values_ = nullptr;
};

}  // namespace

Substructuring::Substructuring(Mat matrix, std::vector<PetscInt> separator)
    : matrix_(matrix), separator_(std::move(separator)), copy_(nullptr, destroy) {
  const std::vector<PetscInt> rows = rows_of_block();
  base::check(ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(rows.size()), rows.data(), PETSC_COPY_VALUES,
                              block_.put()));
  IS block = block_.get();
  Mat* copy = nullptr;
  base::check(MatCreateSubMatrices(matrix_, 1, &block, &block, MAT_INITIAL_MATRIX, &copy));
  copy_.reset(copy);
  separator_to_block_ = positions(separator_, rows);
  PetscInt begin = 0, end = 0;
  base::check(MatGetOwnershipRange(matrix_, &begin, &end));
  for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
    if (rows[i] >= begin && rows[i] < end) owned_and_block_.emplace_back(static_cast<int>(rows[i] - begin), i);
  }
  load_.resize(rows.size());
  pivots_.resize(separator_.size());
  find_entries();
  if (rows.size() > separator_.size()) condensation_.emplace(entries_, separator_to_block_);
}

std::vector<PetscInt> Substructuring::rows_of_block() const {
  PetscInt begin = 0, end = 0;
  base::check(MatGetOwnershipRange(matrix_, &begin, &end));
  std::vector<PetscInt> owned(end - begin), rows;
  for (PetscInt i = begin; i < end; ++i) owned[i - begin] = i;
  std::set_union(owned.begin(), owned.end(), separator_.begin(), separator_.end(), std::back_inserter(rows));
  return rows;
}

void Substructuring::find_entries() {
  const std::size_t size = load_.size();
  std::vector<char> is_shared(size, 0), is_owned(size, 0);
  for (const int i : separator_to_block_) is_shared[i] = 1;
  for (const auto& [owned, i] : owned_and_block_) is_owned[i] = 1;
  entries_.size = static_cast<int>(size);
  PetscInt count = 0;
  const PetscInt *starts = nullptr, *columns = nullptr;
  PetscBool done = PETSC_FALSE;
  base::check(MatGetRowIJ(copy_[0], 0, PETSC_FALSE, PETSC_FALSE, &count, &starts, &columns, &done));
  for (PetscInt i = 0; i < count; ++i) {
    for (PetscInt k = starts[i]; k < starts[i + 1]; ++k) {
      if (is_shared[i] && is_shared[columns[k]] && !is_owned[i]) continue;
      entries_.rows.push_back(i);
      entries_.columns.push_back(columns[k]);
      entry_to_value_.push_back(k);
    }
  }
  base::check(MatRestoreRowIJ(copy_[0], 0, PETSC_FALSE, PETSC_FALSE, &count, &starts, &columns, &done));
  values_.resize(entry_to_value_.size());
}

double Substructuring::dense_share() const {
  const double n = static_cast<double>(separator_.size());
  const double here = condensation_ ? condensation_->operations() : 0;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(matrix_));
  return 2.0 / 3.0 * n * n * n / base::sum(comm, here);
}

bool Substructuring::factorise() {
  IS block = block_.get();
  Mat* copy = copy_.get();
  base::check(MatCreateSubMatrices(matrix_, 1, &block, &block, MAT_REUSE_MATRIX, &copy));
  const Entries values(copy_[0]);
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = values[entry_to_value_[i]];
  const std::size_t n = separator_.size();
  shared_matrix_.resize(n * n);
  bool is_regular = true;
  if (condensation_) {
    is_regular = condensation_->factorise(values_);
    std::copy(condensation_->kept_matrix().begin(), condensation_->kept_matrix().end(), shared_matrix_.begin());
  } else {
    std::fill(shared_matrix_.begin(), shared_matrix_.end(), 0.0);
    for (std::size_t i = 0; i < values_.size(); ++i) {  // the block is the separator
      shared_matrix_[entries_.rows[i] * n + entries_.columns[i]] += values_[i];
    }
  }
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(matrix_));
  if (base::smallest(comm, static_cast<std::int32_t>(is_regular)) == 0) return false;
  MPI_Allreduce(MPI_IN_PLACE, shared_matrix_.data(), static_cast<int>(n * n), MPI_DOUBLE, MPI_SUM, comm);
  PetscBLASInt size = static_cast<PetscBLASInt>(n), info = 0;
  if (n > 0) LAPACKgetrf_(&size, &size, shared_matrix_.data(), &size, pivots_.data(), &info);
  return info == 0;
}

void Substructuring::solve(Vec right_hand_side, Vec solution) {
  std::fill(load_.begin(), load_.end(), 0.0);
  {
    const ReadValues values(right_hand_side);
    for (const auto& [owned, i] : owned_and_block_) load_[i] = values[owned];
  }
  std::span<double> shared = condensation_ ? condensation_->condense(load_) : std::span<double>(load_);
  PetscBLASInt size = static_cast<PetscBLASInt>(separator_.size()), one = 1, info = 0;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(matrix_));
  MPI_Allreduce(MPI_IN_PLACE, shared.data(), size, MPI_DOUBLE, MPI_SUM, comm);
  // Rows of S are columns to LAPACK.
  if (size > 0)
    LAPACKgetrs_("T", &size, &one, shared_matrix_.data(), &size, pivots_.data(), shared.data(), &size, &info);
  const std::span<const double> result = condensation_ ? condensation_->expand() : std::span<const double>(shared);
  const OwnedValues values(solution);
  for (const auto& [owned, i] : owned_and_block_) values[owned] = result[i];
}

}  // namespace vocalis::la
