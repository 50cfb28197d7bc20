#pragma once

#include <string>

#include "tests/transfer/random_case.hpp"
#include "transfer/strip.hpp"

namespace vocalis::transfer {

/// What is wrong with a stripped mesh on this rank, compared with the whole mesh by brute force; empty if all is well.
/// Collective.
std::string check_strip(const RandomCase& from, const std::vector<std::int32_t>& mask, const mesh::Mesh& parent,
                        const StrippedMesh& stripped);

}  // namespace vocalis::transfer
