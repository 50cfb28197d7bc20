#include "acoustic_solver/relative_change.hpp"

#include <array>

namespace vocalis::acoustic {

bool is_small_change(MPI_Comm comm, double change_squared, double size_squared, double part) {
  std::array<double, 2> squares = {change_squared, size_squared};
  MPI_Allreduce(MPI_IN_PLACE, squares.data(), 2, MPI_DOUBLE, MPI_SUM, comm);
  return squares[0] <= part * part * squares[1];
}

}  // namespace vocalis::acoustic
