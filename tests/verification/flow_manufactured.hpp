#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"
#include "fsi_solver/continuum.hpp"
#include "fsi_solver/fsi_solver.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/boxes.hpp"

namespace vocalis::fsi::test {

using Point = std::array<double, 3>;
using Function = std::function<Point(const Point&, double)>;

inline std::vector<FlowBoundary> velocity_all_around() {
  std::vector<FlowBoundary> result;
  for (const char* group : {"left", "right", "bottom", "top"}) {
    result.push_back(boundary(group, FlowBoundaryKind::velocity));
  }
  return result;
}

struct Errors {
  double velocity = 0;  ///< L2
  double gradient = 0;  ///< L2 of the velocity's gradient
  double pressure = 0;  ///< L2 without the mean
  double displacement = 0;
};

/// Where the dofs of the velocity are, (dofs, 2) [m]: the reference moved by a displacement on the same space.
inline std::vector<double> moved(const FsiSolver& solver, const fem::Field& displacement) {
  std::vector<double> points = solver.continuum().reference_points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += displacement.values[i];
  return points;
}

/// The error of a plane field against an exact one, in L2, by a rule of degree 5 on the cells whose velocity dofs are
/// at `x`.
inline double l2_error(const FsiSolver& solver, const std::vector<double>& x, const fem::Field& field,
                       const std::function<Point(const Point&)>& exact, bool without_mean) {
  const fem::Space& cells = solver.velocity_space();
  const fem::QuadratureRule& rule = fem::quadrature(2, 5);
  double square = 0, mean = 0, volume = 0;
  for (std::int32_t cell = 0; cell < cells.mesh->num_cells(); ++cell) {
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      std::array<double, 6> basis = {}, shape = {};
      std::array<double, 18> slopes = {};
      fem::basis_values(2, cells.degree, rule.points[q], shape);
      fem::basis_derivatives(2, cells.degree, rule.points[q], slopes);
      fem::basis_values(2, field.space->degree, rule.points[q], basis);
      Point point = {0, 0, 0};
      double value[2] = {0, 0}, map[2][2] = {};
      for (int a = 0; a < cells.dofs_per_cell; ++a) {
        const double* corner = x.data() + 2 * static_cast<std::size_t>(cells.dofs_of(cell)[a]);
        for (int k = 0; k < 2; ++k) {
          point[k] += shape[a] * corner[k];
          for (int j = 0; j < 2; ++j) map[k][j] += (slopes[3 * a + j + 1] - slopes[3 * a]) * corner[k];
        }
      }
      for (int a = 0; a < field.space->dofs_per_cell; ++a) {
        for (int k = 0; k < field.components; ++k) value[k] += basis[a] * field.at(field.space->dofs_of(cell)[a])[k];
      }
      const double weight = 0.5 * rule.weights[q] * (map[0][0] * map[1][1] - map[0][1] * map[1][0]);
      const Point right = exact(point);
      for (int k = 0; k < field.components; ++k) {
        const double error = value[k] - right[k];
        square += weight * error * error;
        mean += weight * error;
      }
      volume += weight;
    }
  }
  square = base::sum(cells.mesh->comm, square);
  mean = base::sum(cells.mesh->comm, mean);
  volume = base::sum(cells.mesh->comm, volume);
  return std::sqrt(std::max(0.0, square - (without_mean ? mean * mean / volume : 0)));
}

/// Runs `steps` equal steps; the report of the first that fails, or of the last.
inline StepReport run(FsiSolver& solver, double dt, int steps) {
  StepReport report;
  for (int step = 0; step < steps; ++step) {
    report = solver.try_step(dt);
    if (!report.converged) break;
    solver.accept();
  }
  return report;
}

/// Sets velocity and displacement at time 0.
inline void start_from(FsiSolver& solver, const Function& velocity, const Function& displacement) {
  State state = solver.state();
  const Continuum& continuum = solver.continuum();
  for (std::int32_t dof = 0; dof < solver.velocity_space().num_dofs(); ++dof) {
    const double* at = continuum.reference_points.data() + 2 * static_cast<std::size_t>(dof);
    const Point reference = {at[0], at[1], 0};
    Point moved = reference;
    if (displacement) {
      for (int k = 0; k < 2; ++k) moved[k] += state.displacement.at(dof)[k] = displacement(reference, 0)[k];
    }
    const Point value = velocity(continuum.dof_solid[dof] < 0 ? moved : reference, 0);
    for (int k = 0; k < 2; ++k) state.velocity.at(dof)[k] = value[k];
  }
  state.velocity_before = state.velocity;
  state.displacement_before = state.displacement;
  solver.set_state(state);
}

}  // namespace vocalis::fsi::test
