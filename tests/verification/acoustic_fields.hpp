#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "acoustic_solver/acoustic_solver.hpp"

/// Known sound fields on small meshes, for the verification of the acoustic solver.
namespace vocalis::acoustic::verification {

/// A function of the point and time.
using SpaceTime = std::function<double(std::span<const double> point, double time)>;

/// Density and speed of sound 1.
AcousticSettings unit_medium(double step, Integrator integrator);

const char* name(Integrator integrator);

/// A box of the given edges, on the ranks of the world, with cells about as long in all directions; 2-D if size[2] = 0.
mesh::Mesh box_mesh(std::array<double, 3> size, std::array<int, 3> cells);

/// Both fields at the vertices at their present coordinates.
State state_of(const mesh::Mesh& mesh, const SpaceTime& pressure, const SpaceTime& potential, double time);

/// (f(., time), q) on the mesh at other coordinates, summed to the owners.
fem::Load load_of(const fem::Space& space, std::span<const double> coordinates, const SpaceTime& f, double time);

/// |p - exact| / |exact| in L2 at the state's time, on the mesh at its present coordinates.
double relative_error(const AcousticSolver& solver, const SpaceTime& exact);

/// The smallest log2 of an error over the next: the order of convergence where each level halves h (or dt).
double lowest_order(const std::vector<double>& errors);

/// Prints "title errors ... order" on rank 0, for the record of the test.
void print_errors(const char* title, const std::vector<double>& errors, bool with_order = true);

}  // namespace vocalis::acoustic::verification
