#pragma once

#include <catch2/catch.hpp>
#include <vector>

#include "fsi_solver/continuum.hpp"
#include "fsi_solver/fsi_solver.hpp"
#include "tests/fsi_solver/boxes.hpp"

namespace vocalis::fsi::test {

/// A block of tissue above another, with a layer of fluid between them.
inline mesh::Mesh blocks() {
  return box_of_regions({0.01, 0.01, 0}, {6, 10, 0}, {"low", "gap", "high"}, [](const auto& x) {
    return x[1] < 0.004 ? 0 : x[1] < 0.006 ? 1 : 2;
  });
}

/// The lower block is held at its bottom; gravity pulls 20 m/s^2 downwards.
inline FlowSettings block_settings(Elements elements) {
  FlowSettings flow;
  flow.elements = elements;
  flow.density = 1;
  flow.viscosity = 1e-3;
  flow.gravity = {0, -20, 0};
  for (const char* region : {"low", "high"}) {
    SolidMaterial tissue;
    tissue.region = region;
    tissue.young_modulus = 2000;
    tissue.density = 1000;
    tissue.damping = 2;
    flow.solids.push_back(tissue);
  }
  flow.boundaries = {{.group = "bottom", .kind = FlowBoundaryKind::fixed},
                     {.group = "left", .kind = FlowBoundaryKind::outlet},
                     {.group = "right", .kind = FlowBoundaryKind::outlet}};
  flow.contact = ContactMedium{.young_modulus = 2000, .damping = 2};
  flow.mesh_recovery = 0.01;
  return flow;
}

/// No gravity and no wall: zero tractions all around.
inline FlowSettings free_blocks(Elements elements) {
  FlowSettings flow;
  flow.elements = elements;
  flow.density = 1;
  flow.viscosity = 1e-3;
  flow.newton_tolerance = 1e-12;
  for (const char* region : {"low", "high"}) {
    SolidMaterial tissue;
    tissue.region = region;
    tissue.young_modulus = 2000;
    tissue.density = 1000;
    flow.solids.push_back(tissue);
  }
  for (const char* group : {"left", "right"}) {
    flow.boundaries.emplace_back().group = group;
    flow.boundaries.back().kind = FlowBoundaryKind::pressure;
  }
  flow.contact = ContactMedium{.young_modulus = 2000};
  return flow;
}

/// Marks the layer.
inline std::vector<char> cells_between(const FsiSolver& solver) {
  const mesh::Mesh& mesh = *solver.continuum().mesh;
  std::vector<char> marks(mesh.num_cells());
  for (std::size_t cell = 0; cell < marks.size(); ++cell) marks[cell] = mesh.cell_region[cell] == 1;
  return marks;
}

/// The upper block comes down on the lower one, and a little sideways.
inline void start(FsiSolver& solver, double speed) {
  State state = solver.state();
  for (std::int32_t dof = 0; dof < solver.velocity_space().num_dofs(); ++dof) {
    if (solver.continuum().reference_points[2 * static_cast<std::size_t>(dof) + 1] < 0.0059) continue;
    state.velocity.at(dof)[0] = 0.3 * speed;
    state.velocity.at(dof)[1] = -speed;
  }
  state.velocity_before = state.velocity;
  solver.set_state(state);
}

/// Steps that converged before one that did not.
inline int steps_until_failure(FsiSolver& solver, double dt, int steps) {
  for (int step = 0; step < steps; ++step) {
    const StepReport report = solver.try_step(dt);
    UNSCOPED_INFO(step << " " << report.newton_iterations << " " << report.reason);
    if (!report.converged) return step;
    solver.accept();
  }
  return steps;
}

}  // namespace vocalis::fsi::test
