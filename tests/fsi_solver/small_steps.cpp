#include <cmath>
#include <numbers>

#include "core/base/mpi.hpp"
#include "fsi_solver/fsi_solver.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/boxes.hpp"

namespace vocalis::fsi {

namespace {

/// A vortex whose velocity is known, v = (sin πx cos πy, -cos πx sin πy) cos t with p = cos t sin πx sin πy, after ten
/// steps of h² / ν and 25 of `dt`. Returns the largest error of the pressure; its largest value is 1.
double pressure_error(double dt) {
  constexpr double viscous_time = 1.0 / 256;
  constexpr double pi = std::numbers::pi;
  const mesh::Mesh mesh = test::box_of("fluid", {1, 1, 0}, {16, 16, 0});
  FlowSettings settings;
  settings.density = 1;
  settings.viscosity = 1;
  settings.newton_tolerance = 1e-10;
  for (const char* group : {"left", "right", "bottom", "top"}) {
    settings.boundaries.emplace_back().group = group;
    settings.boundaries.back().kind = FlowBoundaryKind::velocity;
  }
  const auto velocity = [](const std::array<double, 3>& x, double t) -> std::array<double, 3> {
    return {std::sin(pi * x[0]) * std::cos(pi * x[1]) * std::cos(t),
            -std::cos(pi * x[0]) * std::sin(pi * x[1]) * std::cos(t), 0};
  };
  Prescribed prescribed;
  prescribed.velocity = velocity;
  prescribed.fluid_force = [&](const std::array<double, 3>& x, double t) -> std::array<double, 3> {
    const auto v = velocity(x, t);
    const double c = std::cos(t), decay = -std::tan(t) + 2 * pi * pi;
    return {
        decay * v[0] + 0.5 * pi * c * c * std::sin(2 * pi * x[0]) + pi * c * std::cos(pi * x[0]) * std::sin(pi * x[1]),
        decay * v[1] + 0.5 * pi * c * c * std::sin(2 * pi * x[1]) + pi * c * std::sin(pi * x[0]) * std::cos(pi * x[1]),
        0};
  };
  FsiSolver solver(mesh, settings, {.scheme = TimeScheme::bdf2}, prescribed);
  State start = solver.state();
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const auto value = velocity({mesh.point(v)[0], mesh.point(v)[1], 0}, 0);
    for (int k = 0; k < 2; ++k) start.velocity.at(v)[k] = start.velocity_before.at(v)[k] = value[k];
  }
  solver.set_state(start);
  // Interpolated values are not free of divergence on the mesh; ten large steps make them so (John, Novo 2015).
  for (int step = 0; step < 35; ++step) {
    REQUIRE_ON_ALL_RANKS(solver.try_step(step < 10 ? viscous_time : dt).converged);
    solver.accept();
  }
  const fem::Field pressure = solver.fluid_pressure();
  double sum = 0, worst = 0, count = 0;
  const auto difference = [&](std::int32_t v) {
    return pressure.at(v)[0] -
           std::cos(solver.time()) * std::sin(pi * mesh.point(v)[0]) * std::sin(pi * mesh.point(v)[1]);
  };
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
    sum += difference(v);
    ++count;
  }
  const double mean = base::sum(MPI_COMM_WORLD, sum) / base::sum(MPI_COMM_WORLD, count);
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) worst = std::max(worst, std::abs(difference(v) - mean));
  return base::largest(MPI_COMM_WORLD, worst);
}

}  // namespace

TEST_CASE("the pressure stays bounded as the step shrinks far below h² / ν") {
  // h² / ν = 1/256: from a step of that size to one ten-thousandth of it.
  const double viscous_time = 1.0 / 256;
  const double at_scale = pressure_error(viscous_time);
  const double below = pressure_error(viscous_time / 100), far_below = pressure_error(viscous_time / 10000);
  INFO("pressure errors " << at_scale << " " << below << " " << far_below);
  CHECK(at_scale < 0.6);  // the viscous stress is 40 times that
  CHECK(below < 1.1 * at_scale);
  CHECK(far_below < 1.1 * at_scale);
}

}  // namespace vocalis::fsi
