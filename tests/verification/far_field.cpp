#include "acoustic_solver/far_field.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "acoustic_solver/microphones.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "core/mesh/geometry.hpp"
#include "tests/acoustic_solver/balls.hpp"
#include "tests/verification/acoustic_fields.hpp"

namespace vocalis::acoustic::verification {
namespace {

// A piston of radius a in a baffle moves with u(t), in a half ball of air of four times its radius that is open to the
// rest. On its axis (Stepanishen 1971, J. Acoust. Soc. Am. 49, 1629)
//   p(z, t) = ρ c (u(t - z / c) - u(t - sqrt(z² + a²) / c)).
constexpr double speed = 350, density = 1.2, piston = 0.025, room = 0.1, width = 0.15e-3, delay = 0.6e-3;
constexpr double distance = 0.4, near = 0.075;  // [m] of the microphones

double velocity(double t) { return std::exp(-std::pow((t - delay) / width, 2)); }
double on_axis(double z, double t) {
  return density * speed * (velocity(t - z / speed) - velocity(t - std::hypot(z, piston) / speed));
}

/// Area of the piston of facets over that of the disc.
double part_of_disc(const mesh::Mesh& mesh) {
  double area = 0;
  for (const mesh::NamedFacet& facet : mesh::facets_of_group(mesh, "piston")) {
    area += mesh::facet_geometry(mesh, facet.cell, facet.index).measure;
  }
  return base::sum(mesh.comm, area) / (std::numbers::pi * piston * piston);
}

/// Errors relative to the largest pressure at `distance`: by the far field of both surfaces, and of what a microphone
/// on the mesh becomes there if pressure is taken to fall as 1 / r.
struct Errors {
  double open = 0, control = 0, extrapolated = 0;
};

Errors errors_of_piston(int cells) {
  const mesh::Mesh mesh = acoustic::test::ball(room, cells, true);
  AcousticSettings settings;
  settings.speed_of_sound = speed;
  settings.density = density;
  settings.step = room / cells / speed;
  settings.boundaries = {{"open", AcousticBoundaryKind::open, 0, room}, {"piston", AcousticBoundaryKind::flux}};
  AcousticSolver solver(mesh, settings);
  std::vector<std::int32_t> has_source(mesh.num_cells(), 0);
  for (const mesh::NamedFacet& facet : mesh::facets_of_group(mesh, "piston")) has_source[facet.cell] = 1;
  const std::vector<MirrorPlane> baffle = {{2, 0}};
  Microphones microphones(mesh,
                          {{"open", {0, 0, distance}, MicrophoneKind::far_field, "open", baffle},
                           {"control", {0, 0, distance}, MicrophoneKind::far_field, "control", baffle},
                           {"near", {0, 0, near}}},
                          {speed, settings.step, has_source});
  const double end = distance / speed + 2.5 * delay;
  CHECK(solver
            .advance(end, {}, {.begin = nullptr, .end = nullptr, .flux = velocity},
                     [&](double time) { microphones.sample(time, solver.state().p); })
            .converged);
  const auto block = microphones.collect();
  const double part = part_of_disc(mesh), later = (distance - near) / speed;
  Errors errors;
  double largest = 0;
  for (std::size_t n = 0; n < block.times.size(); ++n) {
    const double t = block.times[n], exact = part * on_axis(distance, t);
    largest = std::max(largest, std::abs(exact));
    errors.open = std::max(errors.open, std::abs(block.values[3 * n] - exact));
    errors.control = std::max(errors.control, std::abs(block.values[3 * n + 1] - exact));
    const double extrapolated = near / distance * block.values[3 * n + 2];
    errors.extrapolated = std::max(errors.extrapolated, std::abs(extrapolated - part * on_axis(distance, t + later)));
  }
  for (double* error : {&errors.open, &errors.control, &errors.extrapolated}) {
    *error = base::largest(mesh.comm, base::rank(mesh.comm) == 0 ? *error / largest : 0);
  }
  return errors;
}

void piston_on(const std::vector<int>& levels, std::vector<Errors>& all) {
  std::vector<double> open, control, extrapolated;
  for (const int cells : levels) {
    all.push_back(errors_of_piston(cells));
    open.push_back(all.back().open);
    control.push_back(all.back().control);
    extrapolated.push_back(all.back().extrapolated);
  }
  print_errors("baffled piston, far field of the end of the mesh", open);
  print_errors("baffled piston, far field of a sphere inside the mesh", control);
  print_errors("baffled piston, microphone on the mesh times r / R", extrapolated);
}

}  // namespace

TEST_CASE("the far field of a piston in a baffle is that of the half space, where 1 / r from near it is not") {
  std::vector<Errors> errors;
  piston_on({8, 16}, errors);
  CHECK(errors[1].open < 0.04);
  CHECK(errors[1].control < 0.01);
  CHECK(errors[0].open / errors[1].open > 2);
  CHECK(errors[0].control / errors[1].control > 2);
  CHECK(errors[1].extrapolated > 0.04);
}

TEST_CASE("the far field of a piston in a baffle, on a finer mesh", "[.farfield]") {
  std::vector<Errors> errors;
  piston_on({8, 16, 32}, errors);
}

}  // namespace vocalis::acoustic::verification
