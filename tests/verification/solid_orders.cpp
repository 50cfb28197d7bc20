#include "tests/verification/flow_manufactured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

constexpr double pi = std::numbers::pi;

/// A solid that swings far: d = sin(ωt) (0.12 sin πx sin πy, -0.1 sin πx sin 2πy), held at its sides.
struct Swing {
  SolidMaterial material;
  double omega = 3;
  double amplitude = 1;  ///< the Saint Venant-Kirchhoff solid collapses when it is pressed as far as the other

  static Point shape(const Point& x) {
    return {0.12 * std::sin(pi * x[0]) * std::sin(pi * x[1]), -0.1 * std::sin(pi * x[0]) * std::sin(2 * pi * x[1]), 0};
  }
  static Matrix<2> shape_gradient(const Point& x) {
    return {
        {{0.12 * pi * std::cos(pi * x[0]) * std::sin(pi * x[1]), 0.12 * pi * std::sin(pi * x[0]) * std::cos(pi * x[1])},
         {-0.1 * pi * std::cos(pi * x[0]) * std::sin(2 * pi * x[1]),
          -0.2 * pi * std::sin(pi * x[0]) * std::cos(2 * pi * x[1])}}};
  }
  Point velocity(const Point& x, double t) const {
    Point v = shape(x);
    for (double& component : v) component *= amplitude * omega * std::cos(omega * t);
    return v;
  }
  Point displacement(const Point& x, double t) const {
    Point d = shape(x);
    for (double& component : d) component *= amplitude * std::sin(omega * t);
    return d;
  }
  Matrix<2> stress_at(const Point& x, double t) const {
    Matrix<2> f{}, rate{};
    const Matrix<2> g = shape_gradient(x);
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        f[i][j] = (i == j) + amplitude * std::sin(omega * t) * g[i][j];
        rate[i][j] = amplitude * omega * std::cos(omega * t) * g[i][j];
      }
    }
    return stress<2>(elasticity(material), f, rate, 0);
  }
  /// ρ d'' - Div P, the divergence by central differences of fourth order (error about 1e-12 of the stress).
  Point force(const Point& x, double t) const {
    Point result = shape(x);
    for (double& component : result) component *= -amplitude * omega * omega * std::sin(omega * t) * material.density;
    const double h = 1e-3;
    for (int j = 0; j < 2; ++j) {
      const auto at = [&](double step) {
        Point moved = x;
        moved[j] += step;
        return stress_at(moved, t);
      };
      const Matrix<2> a = at(-2 * h), b = at(-h), c = at(h), d = at(2 * h);
      for (int i = 0; i < 2; ++i) result[i] -= (a[i][j] - 8 * b[i][j] + 8 * c[i][j] - d[i][j]) / (12 * h);
    }
    return result;
  }
};

Swing swing(SolidModel model) {
  Swing result;
  result.material.region = "solid";
  result.material.model = model;
  result.amplitude = model == SolidModel::neo_hookean ? 1 : 0.4;
  result.material.density = 1;
  result.material.young_modulus = 10;
  result.material.poisson_ratio = 0.3;
  result.material.damping = 0.1;
  return result;
}

struct Swung {
  std::unique_ptr<FsiSolver> solver;
  Errors errors;
};

Swung run_swing(const Swing& swing, const mesh::Mesh& mesh, int steps, TimeSettings scheme, double end,
                Elements elements = Elements::p1p1) {
  FlowSettings settings;
  settings.elements = elements;
  settings.solids = {swing.material};
  settings.boundaries = velocity_all_around();
  settings.newton_tolerance = 1e-11;
  Prescribed prescribed;
  prescribed.velocity = [&](const Point& x, double t) { return swing.velocity(x, t); };
  prescribed.solid_force = [&](const Point& x, double t) { return swing.force(x, t); };
  Swung result;
  result.solver = std::make_unique<FsiSolver>(mesh, settings, scheme, prescribed);
  FsiSolver& solver = *result.solver;
  start_from(solver, prescribed.velocity, nullptr);
  const StepReport report = run(solver, end / steps, steps);
  INFO(report.reason << " " << report.residual);
  REQUIRE_ON_ALL_RANKS(report.converged);
  const double time = solver.time();
  const std::vector<double>& x = solver.continuum().reference_points;
  result.errors.velocity = l2_error(
      solver, x, solver.state().velocity, [&](const Point& p) { return swing.velocity(p, time); }, false);
  result.errors.displacement = l2_error(
      solver, x, solver.state().displacement, [&](const Point& p) { return swing.displacement(p, time); }, false);
  return result;
}

constexpr TimeSettings midpoint = {.scheme = TimeScheme::theta, .theta = 0.5};
constexpr TimeSettings backward = {.scheme = TimeScheme::theta, .theta = 1};
constexpr TimeSettings bdf2 = {.scheme = TimeScheme::bdf2};

double order(double coarse, double fine) { return std::log2(coarse / fine); }

double distance(const fem::Field& a, const fem::Field& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) sum += std::pow(a.values[i] - b.values[i], 2);
  return std::sqrt(base::sum(MPI_COMM_WORLD, sum));
}

void check_solid_orders(Elements elements, std::array<int, 3> sizes, double expected) {
  for (const SolidModel model : {SolidModel::neo_hookean, SolidModel::saint_venant_kirchhoff}) {
    const Swing exact = swing(model);
    Errors last;
    for (const int cells : sizes) {
      const mesh::Mesh mesh = box_of("solid", {1, 1, 0}, {cells, cells, 0});
      // With order three in space, steps that fall as h² keep their own error below.
      const int steps = elements == Elements::p1p1 ? 2 * cells : 4 * cells * cells;
      const Errors errors = run_swing(exact, mesh, steps, midpoint, 0.5, elements).errors;
      INFO("cells " << cells << " velocity " << errors.velocity << " displacement " << errors.displacement << " orders "
                    << order(last.velocity, errors.velocity) << " " << order(last.displacement, errors.displacement));
      if (cells == sizes[2]) {
        // Coarse quadratic elements do better than they must.
        CHECK(order(last.velocity, errors.velocity) > expected - 0.2);
        CHECK(order(last.displacement, errors.displacement) > expected - 0.2);
      }
      last = errors;
    }
  }
}

}  // namespace

TEST_CASE("solids at large strain converge with order two in space with linear elements, three with quadratic ones") {
  check_solid_orders(Elements::p1p1, {8, 16, 32}, 2);
  check_solid_orders(Elements::p2p1, {3, 6, 12}, 3);
}

TEST_CASE("solids converge in time with the order of their scheme") {
  const mesh::Mesh mesh = box_of("solid", {1, 1, 0}, {6, 6, 0});
  const Swing exact = swing(SolidModel::neo_hookean);
  const Swung reference = run_swing(exact, mesh, 512, midpoint, 0.5);
  for (const auto& [scheme, expected] : {std::pair(midpoint, 2), std::pair(backward, 1), std::pair(bdf2, 2)}) {
    const Swung coarse = run_swing(exact, mesh, 64, scheme, 0.5), fine = run_swing(exact, mesh, 128, scheme, 0.5);
    const State& right = reference.solver->state();
    const double of_velocity = order(distance(coarse.solver->state().velocity, right.velocity),
                                     distance(fine.solver->state().velocity, right.velocity));
    const double of_displacement = order(distance(coarse.solver->state().displacement, right.displacement),
                                         distance(fine.solver->state().displacement, right.displacement));
    INFO("orders in time " << of_velocity << " " << of_displacement);
    CHECK(of_velocity == Approx(expected).margin(0.2));
    CHECK(of_displacement == Approx(expected).margin(0.2));
  }
}

}  // namespace vocalis::fsi
