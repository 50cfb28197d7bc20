#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/mpi.hpp"
#include "fsi_solver/assembly.hpp"
#include "fsi_solver/direct_solver.hpp"
#include "fsi_solver/fsi_solver.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/boxes.hpp"

namespace vocalis::fsi {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double viscous_time = 1.0 / 256;  ///< h² / ν [s]
/// Interpolated values are not free of divergence on the mesh; ten large steps make them so (John, Novo 2015).
constexpr int large_steps = 10, small_steps = 25;

/// A vortex whose velocity is known, v = (sin πx cos πy, -cos πx sin πy) cos t with p = cos t sin πx sin πy, whose
/// largest value is 1.
struct Vortex {
  mesh::Mesh mesh = test::box_of("fluid", {1, 1, 0}, {16, 16, 0});
  FlowSettings settings;
  Prescribed prescribed;

  Vortex() {
    settings.density = 1;
    settings.viscosity = 1;
    settings.newton_tolerance = 1e-10;
    for (const char* group : {"left", "right", "bottom", "top"}) {
      settings.boundaries.emplace_back().group = group;
      settings.boundaries.back().kind = FlowBoundaryKind::velocity;
    }
    prescribed.velocity = velocity;
    prescribed.fluid_force = force;
  }

  static std::array<double, 3> velocity(const std::array<double, 3>& x, double t) {
    return {std::sin(pi * x[0]) * std::cos(pi * x[1]) * std::cos(t),
            -std::cos(pi * x[0]) * std::sin(pi * x[1]) * std::cos(t), 0};
  }

  static std::array<double, 3> force(const std::array<double, 3>& x, double t) {
    const auto v = velocity(x, t);
    const double c = std::cos(t), decay = -std::tan(t) + 2 * pi * pi;
    return {
        decay * v[0] + 0.5 * pi * c * c * std::sin(2 * pi * x[0]) + pi * c * std::cos(pi * x[0]) * std::sin(pi * x[1]),
        decay * v[1] + 0.5 * pi * c * c * std::sin(2 * pi * x[1]) + pi * c * std::sin(pi * x[0]) * std::cos(pi * x[1]),
        0};
  }

  void begin(State& state) const {
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      const auto value = velocity({mesh.point(v)[0], mesh.point(v)[1], 0}, 0);
      for (int k = 0; k < 2; ++k) state.velocity.at(v)[k] = state.velocity_before.at(v)[k] = value[k];
    }
  }

  /// Largest error of a pressure, which is known up to a constant. Collective.
  double error(const fem::Field& pressure, double time) const {
    double sum = 0, worst = 0;
    std::vector<double> differences;
    for (std::int32_t dof = 0; dof < pressure.space->dofs.num_owned; ++dof) {
      const double* x = mesh.point(pressure.space->dof_vertex[dof]);
      differences.push_back(pressure.at(dof)[0] - std::cos(time) * std::sin(pi * x[0]) * std::sin(pi * x[1]));
      sum += differences.back();
    }
    const double count = base::sum(MPI_COMM_WORLD, static_cast<double>(differences.size()));
    const double mean = base::sum(MPI_COMM_WORLD, sum) / count;
    for (const double difference : differences) worst = std::max(worst, std::abs(difference - mean));
    return base::largest(MPI_COMM_WORLD, worst);
  }
};

/// The largest error of the pressure after large steps of h² / ν and small ones of `dt`.
double pressure_error(double dt) {
  const Vortex vortex;
  FsiSolver solver(vortex.mesh, vortex.settings, {.scheme = TimeScheme::bdf2}, vortex.prescribed);
  State start = solver.state();
  vortex.begin(start);
  solver.set_state(start);
  for (int step = 0; step < large_steps + small_steps; ++step) {
    REQUIRE_ON_ALL_RANKS(solver.try_step(step < large_steps ? viscous_time : dt).converged);
    solver.accept();
  }
  return vortex.error(solver.fluid_pressure(), solver.time());
}

/// Solves the step that the assembly has begun by Newton's method. Returns whether that converged. Collective.
bool solve_step(Assembly& assembly, Vec unknowns, Vec result, Vec change) {
  const la::PetscLinearSolver solver = create_gathered_solver(MPI_COMM_WORLD, "small_steps_", Reuse::few_solves);
  for (int iteration = 0; iteration < 8; ++iteration) {
    if (assembly.residual(unknowns, result).error < 1e-10) return true;
    assembly.jacobian();
    base::check(KSPSetOperators(solver.get(), assembly.matrix(), assembly.matrix()));
    base::check(KSPSolve(solver.get(), result, change));
    base::check(VecAXPY(unknowns, -1, change));
  }
  return false;
}

/// The same, by the same equations, but with the time scale of the pressure's stabilisation as it often is, one that
/// goes with the step: 1/τ = ρ/dt + µ Σ_a |∇φ_a|² + ...
double pressure_error_if_scale_follows_step(double dt) {
  const Vortex vortex;
  const Continuum continuum = make_continuum(vortex.mesh, vortex.settings);
  const Conditions conditions = make_conditions(continuum, vortex.settings);
  Assembly assembly(continuum, vortex.settings, conditions, vortex.prescribed, nullptr);
  State state;
  state.velocity = state.velocity_before = state.displacement = state.displacement_before =
      fem::Field(continuum.velocity_space, 2);
  state.pressure = fem::Field(continuum.pressure_space, 1);
  vortex.begin(state);
  const PetscInt owned = assembly.layout().num_owned();
  const la::PetscVector unknowns = la::create_vector(MPI_COMM_WORLD, owned);
  const la::PetscVector result = la::create_vector(MPI_COMM_WORLD, owned);
  const la::PetscVector change = la::create_vector(MPI_COMM_WORLD, owned);
  for (int step = 0; step < large_steps + small_steps; ++step) {
    const double present = step < large_steps ? viscous_time : dt;
    assembly.begin_step(state, make_stage({.scheme = TimeScheme::bdf2}, present, state.last_dt), unknowns.get());
    for (double& scale : assembly.stabilisation().pressure) {
      scale = 1 / (1 / scale + vortex.settings.density / present);
    }
    REQUIRE_ON_ALL_RANKS(solve_step(assembly, unknowns.get(), result.get(), change.get()));
    state.velocity_before = std::exchange(state.velocity, assembly.fields().end_velocity());
    state.pressure = assembly.fields().pressure();
    state.time += present;
    state.last_dt = present;
  }
  return vortex.error(state.pressure, state.time);
}

}  // namespace

TEST_CASE("the pressure stays bounded as the step shrinks far below h² / ν") {
  // From a step of that size to one ten-thousandth of it.
  const double at_scale = pressure_error(viscous_time);
  const double below = pressure_error(viscous_time / 100), far_below = pressure_error(viscous_time / 10000);
  INFO("pressure errors " << at_scale << " " << below << " " << far_below);
  CHECK(at_scale < 0.6);  // the viscous stress is 40 times that
  CHECK(below < 1.1 * at_scale);
  CHECK(far_below < 1.1 * at_scale);
}

TEST_CASE("a stabilisation whose time scale goes with the step loses the pressure at small ones") {
  const double at_scale = pressure_error_if_scale_follows_step(viscous_time);
  const double below = pressure_error_if_scale_follows_step(viscous_time / 100);
  const double far_below = pressure_error_if_scale_follows_step(viscous_time / 10000);
  INFO("pressure errors " << at_scale << " " << below << " " << far_below);
  CHECK(at_scale < 0.6);  // no worse than ours
  CHECK(below > 2 * at_scale);
  CHECK(far_below > 50 * at_scale);
}

}  // namespace vocalis::fsi
