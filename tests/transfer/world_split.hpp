#pragma once

#include <mpi.h>

#include <vector>

#include "core/base/mpi.hpp"

namespace vocalis::transfer {

/// The world cut in two, [0, n) and [n, size), for every n: meshes of any number of ranks in one program, and every
/// rank always busy. Collective to make and to destroy.
class WorldSplits {
 public:
  struct Split {
    MPI_Comm comm = MPI_COMM_NULL;  ///< of the group that this rank is in
    bool is_upper = false;          ///< it is [n, size)
    int groups = 1;                 ///< 2, or 1 if n is the size of the world
  };

  WorldSplits() {
    const int size = base::size(MPI_COMM_WORLD), rank = base::rank(MPI_COMM_WORLD);
    for (int n = 1; n <= size; ++n) {
      Split& split = splits_.emplace_back();
      split.is_upper = rank >= n;
      split.groups = n < size ? 2 : 1;
      MPI_Comm_split(MPI_COMM_WORLD, split.is_upper ? 1 : 0, rank, &split.comm);
    }
  }
  ~WorldSplits() {
    for (Split& split : splits_) MPI_Comm_free(&split.comm);
  }
  WorldSplits(const WorldSplits&) = delete;
  WorldSplits& operator=(const WorldSplits&) = delete;

  /// The lower group has `ranks` ranks.
  const Split& first(int ranks) const { return splits_[ranks - 1]; }
  /// The splits one after the other, over and over.
  const Split& turn(std::int64_t trial) const { return splits_[trial % static_cast<std::int64_t>(splits_.size())]; }

 private:
  std::vector<Split> splits_;
};

}  // namespace vocalis::transfer
