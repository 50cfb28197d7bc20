#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace vocalis::acoustic {

/// The reverse Cuthill–McKee order of a symmetric graph: neighbours come close to each other, so that a sweep over the
/// rows of a matrix finds in the cache what it reads of a vector. Result: the node at each position.
///
/// starts   (nodes + 1) where each node's neighbours begin in `columns`
/// columns  neighbours; numbers from `nodes` on are not nodes and do not count
///
/// Source: Cuthill & McKee 1969; George 1971.
std::vector<std::int32_t> reverse_cuthill_mckee(std::span<const std::int32_t> starts,
                                                std::span<const std::int32_t> columns);

}  // namespace vocalis::acoustic
