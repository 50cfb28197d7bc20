#include "fsi_solver/solution/assembly.hpp"
#include "tests/verification/flow_manufactured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

constexpr double pi = std::numbers::pi;
constexpr int cells = 16;

/// A fluid at rest between walls, under a force that its pressure balances, p = sin πx sin πy.
struct Rest {
  mesh::Mesh mesh = box_of("fluid", {1, 1, 0}, {cells, cells, 0});
  FlowSettings settings;
  Prescribed prescribed;

  Rest(Elements elements, bool is_stabilised) {
    settings.elements = elements;
    settings.pressure_stabilisation = is_stabilised;
    settings.density = 1;
    settings.viscosity = 1;
    prescribed.fluid_force = [](const Point& x, double) -> Point {
      return {pi * std::cos(pi * x[0]) * std::sin(pi * x[1]), pi * std::sin(pi * x[0]) * std::cos(pi * x[1]), 0};
    };
  }
  static Point pressure(const Point& x) { return {std::sin(pi * x[0]) * std::sin(pi * x[1]), 0, 0}; }
};

struct Answer {
  StepReport report;
  double error = 0;  ///< of the pressure, L2
};

Answer solve(Elements elements, bool is_stabilised) {
  const Rest rest(elements, is_stabilised);
  FsiSolver solver(rest.mesh, rest.settings, {.scheme = TimeScheme::theta, .theta = 1}, rest.prescribed);
  Answer answer;
  answer.report = run(solver, 0.1, 5);
  answer.error = l2_error(solver, solver.continuum().reference_points, solver.state().pressure, Rest::pressure, true);
  return answer;
}

/// How much the residual of momentum and mass feels the pressure 1, -1, 0 at the corners of every cell, beside
/// the pressure of the flow: the norm of its change over that by the flow's.
double effect_of_checkerboard(Elements elements, bool is_stabilised) {
  const Rest rest(elements, is_stabilised);
  const FsiSolver solver(rest.mesh, rest.settings, {.scheme = TimeScheme::theta, .theta = 1}, rest.prescribed);
  const Continuum& continuum = solver.continuum();
  const Conditions conditions = make_conditions(continuum, rest.settings);
  Assembly assembly(continuum, rest.settings, conditions, rest.prescribed, nullptr);
  const la::SystemLayout& layout = assembly.layout();
  const la::PetscVector unknowns = la::create_vector(MPI_COMM_WORLD, layout.num_owned());
  const la::PetscVector result = la::create_vector(MPI_COMM_WORLD, layout.num_owned());
  assembly.begin_step(solver.state(), make_stage({.scheme = TimeScheme::theta, .theta = 1}, 0.1, 0),
                      Start::extrapolated, unknowns.get());
  const auto residual_of = [&](const auto& pressure_at) {
    fem::Field pressure(continuum.pressure_space, 1);
    for (std::int32_t dof = 0; dof < continuum.pressure_space.dofs.num_owned; ++dof) {
      pressure.at(dof)[0] = pressure_at(rest.mesh.point(continuum.pressure_space.dof_vertex[dof]));
    }
    layout.copy_owned_to_system(1, pressure.values, la::OwnedValues(unknowns.get()).data());
    assembly.residual(unknowns.get(), result.get());
    const la::ReadValues values(result.get());
    const auto count = elements == Elements::p1p1 ? layout.start(2) : layout.num_owned();
    return std::vector<double>(values.data(), values.data() + count);
  };
  const std::vector<double> none = residual_of([](const double*) { return 0.0; });
  const auto change = [&](const std::vector<double>& residual) {
    double sum = 0;
    for (std::size_t i = 0; i < none.size(); ++i) sum += (residual[i] - none[i]) * (residual[i] - none[i]);
    return std::sqrt(base::sum(MPI_COMM_WORLD, sum));
  };
  // The corners of a cell, which a diagonal cuts from a square, lie on three lines i + j = const in a row.
  const double checkerboard = change(residual_of([](const double* x) {
    const double values[3] = {1, -1, 0};
    return values[std::lround((x[0] + x[1]) * cells) % 3];
  }));
  return checkerboard / change(residual_of([](const double* x) { return Rest::pressure({x[0], x[1], 0})[0]; }));
}

}  // namespace

TEST_CASE("P1P1 does not see a checkerboard of pressures, unless it is stabilised; P2P1 does") {
  const double bare = effect_of_checkerboard(Elements::p1p1, false);
  const double stabilised = effect_of_checkerboard(Elements::p1p1, true);
  const double quadratic = effect_of_checkerboard(Elements::p2p1, false);
  INFO("effect with P1P1 " << bare << " stabilised " << stabilised << " with P2P1 " << quadratic);
  CHECK(bare < 1e-10);
  CHECK(stabilised > 0.1);
  CHECK(quadratic > 0.1);
}

TEST_CASE("a step with P1P1 and no stabilisation fails with a reason") {
  const Answer bare = solve(Elements::p1p1, false);
  INFO(bare.report.reason);
  CHECK_FALSE(bare.report.converged);
  CHECK_FALSE(bare.report.reason.empty());
}

TEST_CASE("stabilised P1P1 finds the pressure, and P2P1 does without") {
  const Answer linear = solve(Elements::p1p1, true), quadratic = solve(Elements::p2p1, false);
  INFO("errors with P1P1 " << linear.error << " with P2P1 " << quadratic.error);
  CHECK(linear.report.converged);
  CHECK(linear.error < 0.02);
  CHECK(quadratic.report.converged);
  CHECK(quadratic.error < 0.02);
}

}  // namespace vocalis::fsi
