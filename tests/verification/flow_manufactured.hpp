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

inline FlowBoundary boundary(const std::string& group, FlowBoundaryKind kind) {
  FlowBoundary result;
  result.group = group;
  result.kind = kind;
  return result;
}

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

/// The error of a plane field against an exact one, in L2, by a rule of degree 4 on the cells at `x`.
inline double l2_error(const mesh::Mesh& mesh, const std::vector<double>& x,
                       const std::function<std::int32_t(std::int32_t, int)>& dof, const fem::Field& field,
                       const std::function<Point(const Point&)>& exact, bool without_mean) {
  const fem::QuadratureRule& rule = fem::quadrature(2, 4);
  double square = 0, mean = 0, volume = 0;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto vertices = mesh.vertices_of(cell);
    std::array<const double*, 3> corners;
    for (int a = 0; a < 3; ++a) corners[a] = x.data() + 2 * static_cast<std::size_t>(vertices[a]);
    const double measure = fem::simplex_geometry<2>(corners).measure;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      Point point = {0, 0, 0};
      double value[2] = {0, 0};
      for (int a = 0; a < 3; ++a) {
        for (int k = 0; k < 2; ++k) point[k] += rule.points[q][a] * corners[a][k];
        for (int k = 0; k < field.components; ++k) value[k] += rule.points[q][a] * field.at(dof(cell, a))[k];
      }
      const Point right = exact(point);
      for (int k = 0; k < field.components; ++k) {
        const double error = value[k] - right[k];
        square += rule.weights[q] * measure * error * error;
        mean += rule.weights[q] * measure * error;
      }
      volume += rule.weights[q] * measure;
    }
  }
  square = base::sum(mesh.comm, square);
  mean = base::sum(mesh.comm, mean);
  volume = base::sum(mesh.comm, volume);
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
  const mesh::Mesh& mesh = *solver.continuum().mesh;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const Point reference = {mesh.point(v)[0], mesh.point(v)[1], 0};
    Point moved = reference;
    if (displacement) {
      for (int k = 0; k < 2; ++k) moved[k] += state.displacement.at(v)[k] = displacement(reference, 0)[k];
    }
    const Point value = velocity(solver.continuum().vertex_solid[v] < 0 ? moved : reference, 0);
    for (int k = 0; k < 2; ++k) state.velocity.at(v)[k] = value[k];
  }
  state.velocity_before = state.velocity;
  state.displacement_before = state.displacement;
  solver.set_state(state);
}

}  // namespace vocalis::fsi::test
