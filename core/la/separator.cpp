#include "core/la/separator.hpp"

#include "core/base/mpi.hpp"

namespace vocalis::la {

std::vector<PetscInt> find_separator(Mat matrix) {
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(matrix));
  PetscInt begin = 0, end = 0;
  base::check(MatGetOwnershipRange(matrix, &begin, &end));
  const PetscVector couples_upwards = create_vector(comm, end - begin);
  for (PetscInt row = begin; row < end; ++row) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    base::check(MatGetRow(matrix, row, &count, &columns, nullptr));
    for (PetscInt i = 0; i < count; ++i) {
      if (columns[i] < begin) base::check(VecSetValue(couples_upwards.get(), columns[i], 1, ADD_VALUES));
      if (columns[i] >= end) base::check(VecSetValue(couples_upwards.get(), row, 1, ADD_VALUES));
    }
    base::check(MatRestoreRow(matrix, row, &count, &columns, nullptr));
  }
  base::check(VecAssemblyBegin(couples_upwards.get()));
  base::check(VecAssemblyEnd(couples_upwards.get()));
  std::vector<PetscInt> mine;
  const ReadValues values(couples_upwards.get());
  for (PetscInt i = 0; i < end - begin; ++i) {
    if (values[i] > 0) mine.push_back(begin + i);
  }
  return base::concatenate_all(comm, mine);
}

}  // namespace vocalis::la
