#include "core/la/petsc.hpp"

namespace vocalis::la {

PetscVector create_vector(MPI_Comm comm, PetscInt num_owned) {
  PetscVector vector;
  base::check(VecCreateMPI(comm, num_owned, PETSC_DETERMINE, vector.put()));
  base::check(VecSet(vector.get(), 0.0));
  return vector;
}

}  // namespace vocalis::la
