#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/fem/facet_integrals.hpp"
#include "fsi_solver/continuum.hpp"
#include "fsi_solver/fsi_solver.hpp"

namespace vocalis::fsi::test {

/// Out of the mesh through a group of facets where they are now [m^3/s], in the plane a metre of depth. Collective.
inline double flux(const FsiSolver& solver, const std::string& group) {
  std::vector<double> points = solver.continuum().reference_points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += solver.state().displacement.values[i];
  return fem::flux_through(solver.state().velocity, points, fem::facets_seen_once(*solver.continuum().mesh, group));
}

/// The largest magnitude on any rank. Collective.
inline double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return base::largest(MPI_COMM_WORLD, result);
}

}  // namespace vocalis::fsi::test
