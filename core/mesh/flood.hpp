#pragma once

#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace vocalis::mesh {

/// Marks, (local cells), all that can be reached from the marked cells without passing a barred facet. Collective.
///
/// from       (owned cells) not 0: marked
/// is_barred  (owned cells, dimension + 1) of the facet opposite to each vertex; an inner facet must be barred from
///            both of its sides
std::vector<std::int32_t> flooded(const Mesh& mesh, std::span<const std::int32_t> from,
                                  std::span<const char> is_barred);

}  // namespace vocalis::mesh
