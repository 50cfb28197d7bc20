#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "acoustic_solver/acoustic_solver.hpp"
#include "core/mesh/generate.hpp"

namespace vocalis::acoustic::test {

inline AcousticSettings unit_medium(double step, Integrator integrator = Integrator::implicit) {
  AcousticSettings settings;
  settings.integrator = integrator;
  settings.speed_of_sound = 1;
  settings.density = 2;
  settings.step = step;
  settings.solver_tolerance = 1e-12;
  return settings;
}

/// Of length 1, 0.5, 0.25 with cubes of 1 / cells.
inline mesh::Mesh unit_box(MPI_Comm comm, int dimension, int cells) {
  return mesh::distribute(comm, mesh::box(comm, {1, 0.5, dimension == 3 ? 0.25 : 0.0}, {cells, cells / 2, cells / 4}));
}

/// A smooth bump of pressure that is not symmetric, zero potential.
inline State bump(const mesh::Mesh& mesh) {
  State state;
  state.psi.assign(mesh.num_vertices(), 0.0);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    double square = 0;
    const double centre[3] = {0.3, 0.2, 0.1};
    for (int k = 0; k < mesh.dimension; ++k) square += std::pow((mesh.point(v)[k] - centre[k]) / 0.15, 2);
    state.p.push_back(std::exp(-square));
  }
  return state;
}

/// x moved by a smooth field that vanishes on the boundary.
inline std::vector<double> deformed(const mesh::Mesh& mesh, double amplitude) {
  std::vector<double> result = mesh.coordinates;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const double* x = mesh.point(v);
    double shape = std::sin(std::numbers::pi * x[0]) * std::sin(2 * std::numbers::pi * x[1]);
    if (mesh.dimension == 3) shape *= std::sin(4 * std::numbers::pi * x[2]);
    result[static_cast<std::size_t>(v) * mesh.dimension] += amplitude * shape;
  }
  return result;
}

/// Values of owned vertices by the numbers of the input mesh, on every rank. Collective.
inline std::vector<double> by_input_number(const mesh::Mesh& mesh, const std::vector<double>& values) {
  std::vector<double> all(mesh.vertices.num_global, 0.0);
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) all[mesh.vertex_input[v]] = values[v];
  MPI_Allreduce(MPI_IN_PLACE, all.data(), static_cast<int>(all.size()), MPI_DOUBLE, MPI_SUM, mesh.comm);
  return all;
}

inline double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i) result = std::max(result, std::abs(a[i] - b[i]));
  return result;
}

}  // namespace vocalis::acoustic::test
