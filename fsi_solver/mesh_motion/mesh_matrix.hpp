#pragma once

#include <memory>
#include <vector>

#include "core/la/assembled_matrix.hpp"
#include "core/la/system_layout.hpp"
#include "fsi_solver/conditions.hpp"
#include "fsi_solver/continuum.hpp"

namespace vocalis::fsi {

/// Which places of the fluid's vertices are given: those of solids' vertices, and what boundaries hold. (owned
/// vertices, dimension)
std::vector<char> constrained_places(const Continuum& continuum, const Conditions& conditions);

/// The matrix for the places of the fluid's vertices, as of an elastic body: the cells give (n, n) numbers each, n =
/// (dimension + 1) dimension, of which those of solid cells are left out. Rows of constrained places are those of the
/// identity; their columns stay: a right hand side that holds what they are is then all that a solve needs. Collective.
///
/// layout  of the mesh's vertices, with a component an axis
std::unique_ptr<la::AssembledMatrix> make_mesh_matrix(const Continuum& continuum, const la::SystemLayout& layout,
                                                      const std::vector<char>& constrained);

}  // namespace vocalis::fsi
