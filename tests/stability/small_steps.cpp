#include <algorithm>
#include <sstream>
#include <utility>

#include "fsi_solver/solution/assembly.hpp"
#include "fsi_solver/solution/direct_solver.hpp"
#include "tests/verification/flow_manufactured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

constexpr double pi = std::numbers::pi;
constexpr int cells = 16;
constexpr double viscous_time = 1.0 / (cells * cells);  ///< h² / ν [s]
constexpr int large_steps = 10, small_steps = 25;

/// How the velocity begins. Interpolated values are not free of divergence on the mesh; ten steps of h² / ν make them
/// so (John, Novo 2015, SIAM J. Numer. Anal. 53, 1005).
enum class Beginning { interpolated, free_of_divergence };

/// A vortex whose velocity is known, v = (sin πx cos πy, -cos πx sin πy) cos t with p = cos t sin πx sin πy, whose
/// largest value is 1.
struct Vortex {
  mesh::Mesh mesh = box_of("fluid", {1, 1, 0}, {cells, cells, 0});
  FlowSettings settings;
  Prescribed prescribed;

  explicit Vortex(Elements elements) {
    settings.elements = elements;
    settings.density = 1;
    settings.viscosity = 1;
    settings.newton_tolerance = 1e-10;
    settings.boundaries = velocity_all_around();
    prescribed.velocity = velocity;
    prescribed.fluid_force = force;
  }

  static Point velocity(const Point& x, double t) {
    return {std::sin(pi * x[0]) * std::cos(pi * x[1]) * std::cos(t),
            -std::cos(pi * x[0]) * std::sin(pi * x[1]) * std::cos(t), 0};
  }

  static Point force(const Point& x, double t) {
    const Point v = velocity(x, t);
    const double c = std::cos(t), decay = -std::tan(t) + 2 * pi * pi;
    return {
        decay * v[0] + 0.5 * pi * c * c * std::sin(2 * pi * x[0]) + pi * c * std::cos(pi * x[0]) * std::sin(pi * x[1]),
        decay * v[1] + 0.5 * pi * c * c * std::sin(2 * pi * x[1]) + pi * c * std::sin(pi * x[0]) * std::cos(pi * x[1]),
        0};
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

/// The largest error of the pressure after small steps of `dt`.
double pressure_error(Elements elements, Beginning start, double dt) {
  const Vortex vortex(elements);
  FsiSolver solver(vortex.mesh, vortex.settings, {.scheme = TimeScheme::bdf2}, vortex.prescribed);
  start_from(solver, Vortex::velocity, nullptr);
  if (start == Beginning::free_of_divergence) {
    REQUIRE_ON_ALL_RANKS(run(solver, viscous_time, large_steps).converged);
  }
  REQUIRE_ON_ALL_RANKS(run(solver, dt, small_steps).converged);
  return vortex.error(solver.fluid_pressure(), solver.time());
}

/// Solves the step that the assembly has begun by Newton's method. Returns whether that converged. Collective.
bool solve_step(Assembly& assembly, Vec unknowns, Vec result, Vec change) {
  const la::PetscLinearSolver solver = create_repeatable_solver(assembly.matrix(), "small_steps_", Reuse::few_solves);
  for (int iteration = 0; iteration < 8; ++iteration) {
    if (assembly.residual(unknowns, result).error < 1e-10) return true;
    assembly.jacobian();
    base::check(KSPSetOperators(solver.get(), assembly.matrix(), assembly.matrix()));
    base::check(KSPSolve(solver.get(), result, change));
    base::check(VecAXPY(unknowns, -1, change));
  }
  return false;
}

/// The same with P1P1, by the same equations, but with the time scale of the pressure's stabilisation as it often is,
/// one that goes with the step: 1/τ = ρ/dt + µ Σ_a |∇φ_a|² + ...
double pressure_error_if_scale_follows_step(Beginning start, double dt) {
  const Vortex vortex(Elements::p1p1);
  FsiSolver beginning(vortex.mesh, vortex.settings, {.scheme = TimeScheme::bdf2}, vortex.prescribed);
  start_from(beginning, Vortex::velocity, nullptr);
  const Continuum& continuum = beginning.continuum();
  const Conditions conditions = make_conditions(continuum, vortex.settings);
  Assembly assembly(continuum, vortex.settings, conditions, vortex.prescribed, nullptr);
  State state = beginning.state();
  const PetscInt owned = assembly.layout().num_owned();
  const la::PetscVector unknowns = la::create_vector(MPI_COMM_WORLD, owned);
  const la::PetscVector result = la::create_vector(MPI_COMM_WORLD, owned);
  const la::PetscVector change = la::create_vector(MPI_COMM_WORLD, owned);
  const int before = start == Beginning::free_of_divergence ? large_steps : 0;
  for (int step = 0; step < before + small_steps; ++step) {
    const double present = step < before ? viscous_time : dt;
    assembly.begin_step(state, make_stage({.scheme = TimeScheme::bdf2}, present, state.last_dt), Start::extrapolated,
                        unknowns.get());
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

/// Errors with steps of h² / ν, a tenth, a hundredth and a ten-thousandth of it.
template <class Error>
std::array<double, 4> errors_as_steps_shrink(const Error& error) {
  return {error(viscous_time), error(viscous_time / 10), error(viscous_time / 100), error(viscous_time / 10000)};
}

std::string listed(const std::array<double, 4>& errors) {
  std::ostringstream text;
  for (const double error : errors) text << " " << error;
  return text.str();
}

}  // namespace

TEST_CASE("the pressure stays bounded as the step shrinks far below h² / ν") {
  const auto errors = errors_as_steps_shrink(
      [](double dt) { return pressure_error(Elements::p1p1, Beginning::free_of_divergence, dt); });
  INFO("pressure errors" << listed(errors));
  CHECK(errors[0] < 0.6);  // the viscous stress is 40 times that
  for (const double error : errors) CHECK(error < 1.1 * errors[0]);
}

TEST_CASE("a stabilisation whose time scale goes with the step loses the pressure at small ones") {
  const auto errors = errors_as_steps_shrink(
      [](double dt) { return pressure_error_if_scale_follows_step(Beginning::free_of_divergence, dt); });
  INFO("pressure errors" << listed(errors));
  CHECK(errors[0] < 0.6);  // no worse than ours
  CHECK(errors[1] > 1.2 * errors[0]);
  CHECK(errors[2] > 2 * errors[0]);
  CHECK(errors[3] > 50 * errors[0]);
}

TEST_CASE("the shock of interpolated initial values dies out, unless the time scale goes with the step") {
  const double at_scale = pressure_error(Elements::p1p1, Beginning::interpolated, viscous_time);
  const double ours = pressure_error(Elements::p1p1, Beginning::interpolated, viscous_time / 100);
  const double with_step = pressure_error_if_scale_follows_step(Beginning::interpolated, viscous_time / 100);
  INFO("pressure errors " << at_scale << " ours " << ours << " with the step " << with_step);
  CHECK(ours < 1.1 * at_scale);
  CHECK(with_step > 2 * at_scale);
}

TEST_CASE("P2P1 does not feel small steps, whatever it starts from") {
  for (const Beginning start : {Beginning::interpolated, Beginning::free_of_divergence}) {
    const auto errors =
        errors_as_steps_shrink([start](double dt) { return pressure_error(Elements::p2p1, start, dt); });
    INFO("pressure errors" << listed(errors));
    for (const double error : errors) CHECK(error < 0.007);
  }
}

}  // namespace vocalis::fsi
