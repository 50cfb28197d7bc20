#pragma once

#include <cstdint>
#include <vector>

#include "core/base/halo.hpp"
#include "core/base/index_map.hpp"

namespace vocalis::transfer {

/// The entities of one kind (vertices, edges) that touch a kept cell of this rank, renumbered.
struct SurvivingEntities {
  base::IndexMap map;
  std::vector<std::int32_t> to_parent;    ///< (map.num_local)
  std::vector<std::int32_t> from_parent;  ///< (parent local), -1 where this rank claims nothing
};

/// Gives each claimed entity one owner, the lowest rank that claims it, and numbers owned entities and ghosts in the
/// parent's order. Copies of an entity meet at its owner in the parent, whether that rank claims it or not, so nobody
/// searches for neighbours.
///
/// claimed  (parent local) not 0 where a kept cell of this rank touches the entity
/// Collective.
SurvivingEntities survive(const base::IndexMap& parent, const base::Halo& parent_halo,
                          const std::vector<std::int32_t>& claimed);

}  // namespace vocalis::transfer
