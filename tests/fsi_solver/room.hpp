#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/mpi.hpp"
#include "fsi_solver/conditions.hpp"
#include "tests/fsi_solver/boxes.hpp"

namespace vocalis::fsi::test {

/// A square or cubic room of 3 m with a solid block of about 1 m in its middle, which moves as a rigid body, and cells
/// of all sizes; `slippery` lets the mesh slide along the top.
struct Room {
  mesh::Mesh mesh;
  Continuum continuum;
  Conditions conditions;

  explicit Room(int dimension, int cells, bool slippery = false, MPI_Comm comm = MPI_COMM_WORLD)
      : mesh(box_of_regions(
            {3, 3, dimension == 3 ? 3.0 : 0.0}, {cells, cells, dimension == 3 ? cells : 0}, {"air", "block"},
            [dimension](const std::array<double, 3>& x) {
              double farthest = 0;
              for (int k = 0; k < dimension; ++k) farthest = std::max(farthest, std::abs(x[k] - 1.5));
              return farthest < 0.5 ? 1 : 0;
            },
            comm)) {
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      double* x = mesh.coordinates.data() + static_cast<std::size_t>(v) * dimension;
      const double wave = 2 * std::numbers::pi / 3, y = x[1];
      x[1] += 0.1 * std::cos(wave * x[0]) * std::sin(wave * y);
      x[0] += 0.1 * std::sin(wave * x[0]) * std::cos(wave * y);
    }
    FlowSettings settings;
    settings.solids.resize(1);
    settings.solids[0].region = "block";
    settings.solids[0].young_modulus = 1;
    if (slippery) {
      settings.boundaries.resize(1);
      settings.boundaries[0].group = "top";
      settings.boundaries[0].kind = FlowBoundaryKind::symmetry;
    }
    continuum = make_continuum(mesh, settings);
    conditions = make_conditions(continuum, settings);
  }

  fem::Field at_rest() const { return {continuum.vertex_space, mesh.dimension}; }

  /// The block turned about the z axis [degree] and shifted along x [m]; the air at rest.
  fem::Field moved(double angle, double shift) const {
    fem::Field result = at_rest();
    const double c = std::cos(angle * std::numbers::pi / 180), s = std::sin(angle * std::numbers::pi / 180);
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      if (continuum.vertex_solid[v] < 0) continue;
      const double x = mesh.point(v)[0] - 1.5, y = mesh.point(v)[1] - 1.5;
      result.at(v)[0] = c * x - s * y - x + shift;
      result.at(v)[1] = s * x + c * y - y;
    }
    return result;
  }

  double quality(const fem::Field& displacement) const { return smallest_fluid_quality(continuum, displacement); }
};

inline double largest_difference(const fem::Field& a, const fem::Field& b) {
  double result = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) result = std::max(result, std::abs(a.values[i] - b.values[i]));
  return base::largest(MPI_COMM_WORLD, result);
}

}  // namespace vocalis::fsi::test
