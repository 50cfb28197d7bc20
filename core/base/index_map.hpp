#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

namespace vocalis::base {

/// Who owns a distributed index. Local indices are the owned ones, then the ghosts; owned indices are contiguous
/// globally: global = offset + local. (The idea of an index map is that of FEniCS/dolfinx.)
struct IndexMap {
  MPI_Comm comm = MPI_COMM_NULL;
  std::int32_t num_owned = 0;
  std::int64_t offset = 0;  ///< first global index of this rank
  std::int64_t num_global = 0;
  std::vector<std::int64_t> ghost_global;  ///< global index of each ghost
  std::vector<int> ghost_owner;            ///< rank that owns each ghost

  std::int32_t num_ghosts() const { return static_cast<std::int32_t>(ghost_global.size()); }
  std::int32_t num_local() const { return num_owned + num_ghosts(); }
  std::int64_t to_global(std::int32_t local) const {
    return local < num_owned ? offset + local : ghost_global[local - num_owned];
  }
};

/// An index map without ghosts; the offset is an exclusive scan over the ranks. Collective.
IndexMap contiguous_index_map(MPI_Comm comm, std::int32_t num_owned);

/// Entities that several ranks know by a common key, given one owner each.
struct SharedNumbering {
  IndexMap map;
  std::vector<std::int32_t> key_to_local;  ///< for each given key its local index
};

/// Numbers entities that ranks share: the owner of a key is the lowest rank that lists it. Owned indices keep the
/// order of the keys, and so do ghosts. Keys must be non-negative and distinct on a rank. The ranks meet at rank
/// key % size, so nobody searches for neighbours. Collective.
SharedNumbering number_shared(MPI_Comm comm, const std::vector<std::int64_t>& keys);

}  // namespace vocalis::base
