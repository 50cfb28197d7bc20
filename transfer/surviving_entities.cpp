#include "transfer/surviving_entities.hpp"

#include <cassert>
#include <limits>

#include "core/base/mpi.hpp"

namespace vocalis::transfer {

SurvivingEntities survive(const base::IndexMap& parent, const base::Halo& parent_halo,
                          const std::vector<std::int32_t>& claimed) {
  const std::int32_t num_parent = parent.num_local();
  assert(claimed.size() == static_cast<std::size_t>(num_parent));
  const std::int32_t here = base::rank(parent.comm);

  std::vector<std::int32_t> owner(num_parent, std::numeric_limits<std::int32_t>::max());
  for (std::int32_t i = 0; i < num_parent; ++i) {
    if (claimed[i]) owner[i] = here;
  }
  parent_halo.min_to_owners(owner);
  parent_halo.copy_to_ghosts(owner);

  SurvivingEntities result;
  result.from_parent.assign(num_parent, -1);
  std::vector<std::int32_t> index_at_owner(num_parent, -1);
  for (std::int32_t i = 0; i < num_parent; ++i) {
    if (!claimed[i] || owner[i] != here) continue;
    index_at_owner[i] = result.from_parent[i] = static_cast<std::int32_t>(result.to_parent.size());
    result.to_parent.push_back(i);
  }
  result.map = base::contiguous_index_map(parent.comm, static_cast<std::int32_t>(result.to_parent.size()));
  parent_halo.max_to_owners(index_at_owner);
  parent_halo.copy_to_ghosts(index_at_owner);

  const std::vector<std::int64_t> offsets = base::gather_all(parent.comm, result.map.offset);
  for (std::int32_t i = 0; i < num_parent; ++i) {
    if (!claimed[i] || owner[i] == here) continue;
    result.from_parent[i] = static_cast<std::int32_t>(result.to_parent.size());
    result.to_parent.push_back(i);
    result.map.ghost_owner.push_back(owner[i]);
    result.map.ghost_global.push_back(offsets[owner[i]] + index_at_owner[i]);
  }
  return result;
}

}  // namespace vocalis::transfer
