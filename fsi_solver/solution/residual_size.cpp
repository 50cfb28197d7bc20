#include "fsi_solver/solution/residual_size.hpp"

#include <algorithm>
#include <cmath>

namespace vocalis::fsi {

ResidualSize ResidualSums::total(MPI_Comm comm) {
  MPI_Allreduce(MPI_IN_PLACE, sums_.data(), static_cast<int>(sums_.size()), MPI_DOUBLE, MPI_SUM, comm);
  const double* terms = sums_.data();
  const double* entries = terms + 3 * labels_;
  ResidualSize result;
  result.inverted = sums_.back() > 0;
  for (int block = 0; block < 3 * labels_; ++block) {
    if (entries[block] == 0) continue;
    const double error = std::sqrt(entries[block] / terms[block]);
    result.error = std::isnan(error) ? error : std::max(result.error, error);
    if (std::isnan(result.error)) break;
  }
  return result;
}

}  // namespace vocalis::fsi
