#include <sstream>

#include "tests/verification/flow_manufactured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

/// A cantilever 10 x 1 in plane strain that sags a little under its weight.
struct Cantilever {
  double length = 10, density = 1, gravity = 0.01, young_modulus = 1e5;
  double poisson_ratio = 0.4;
  bool incompressible = false;

  /// Deflection of the tip [m] by Timoshenko's theory: bending, and shear with the factor 5/6.
  double theory() const {
    const double ratio = incompressible ? 0.5 : poisson_ratio, load = density * gravity;
    const double bending = load * std::pow(length, 4) * 12 * (1 - ratio * ratio) / (8 * young_modulus);
    const double shearing = load * length * length * 2 * (1 + ratio) / (2 * 5.0 / 6 * young_modulus);
    return bending + shearing;
  }
};

/// Deflection of the tip on squares cut into two triangles, over that of theory.
double deflection(const Cantilever& beam, Elements elements, int cells_across) {
  const int along = static_cast<int>(beam.length) * cells_across;
  const mesh::Mesh mesh = box_of("beam", {beam.length, 1, 0}, {along, cells_across, 0});
  FlowSettings settings;
  settings.elements = elements;
  settings.solids.emplace_back().region = "beam";
  settings.solids[0].density = beam.density;
  settings.solids[0].young_modulus = beam.young_modulus;
  settings.solids[0].poisson_ratio = beam.poisson_ratio;
  settings.solids[0].incompressible = beam.incompressible;
  settings.gravity = {0, -beam.gravity, 0};
  settings.boundaries = {boundary("left", FlowBoundaryKind::fixed)};
  // Backward Euler with a huge step comes to rest at once.
  FsiSolver solver(mesh, settings, {.scheme = TimeScheme::theta, .theta = 1});
  const StepReport report = run(solver, 1e4, 5);
  INFO(report.reason);
  REQUIRE_ON_ALL_RANKS(report.converged);
  const fem::Field displacement = solver.displacement_at_vertices();
  double lowest = 0;
  for (std::int32_t vertex = 0; vertex < mesh.num_vertices(); ++vertex) {
    if (mesh.point(vertex)[0] > beam.length - 1e-9) lowest = std::max(lowest, -displacement.at(vertex)[1]);
  }
  return base::largest(MPI_COMM_WORLD, lowest) / beam.theory();
}

/// Deflections of two linear elements across, of four, which have as many velocities as two quadratic ones, and of
/// those; by theory 1.
struct Deflections {
  double linear, linear_of_same_size, quadratic;
};

Deflections deflections(const Cantilever& beam) {
  return {deflection(beam, Elements::p1p1, 2), deflection(beam, Elements::p1p1, 4),
          deflection(beam, Elements::p2p1, 2)};
}

std::string listed(const Deflections& all) {
  std::ostringstream text;
  text << "deflections over theory: P1 " << all.linear << ", P1 with as many unknowns as P2 " << all.linear_of_same_size
       << ", P2 " << all.quadratic;
  return text.str();
}

}  // namespace

TEST_CASE("linear elements lock in bending, quadratic ones do not") {
  const Deflections all = deflections({.poisson_ratio = 0.4});
  INFO(listed(all));
  CHECK(all.linear < 0.5);
  CHECK(all.linear_of_same_size < 0.8);
  CHECK(all.quadratic == Approx(1).epsilon(0.03));
}

TEST_CASE("linear elements lock harder where the material is nearly incompressible, quadratic ones hardly") {
  const Deflections all = deflections({.poisson_ratio = 0.49});
  INFO(listed(all));
  CHECK(all.linear < 0.15);
  CHECK(all.linear_of_same_size < 0.35);
  CHECK(all.quadratic == Approx(1).epsilon(0.07));
}

TEST_CASE("a pressure of its own frees the incompressible solid of that, but not linear elements of bending") {
  const Deflections all = deflections({.incompressible = true});
  INFO(listed(all));
  CHECK(all.linear > 0.5);
  CHECK(all.linear < 0.7);
  CHECK(all.quadratic == Approx(1).epsilon(0.05));
}

}  // namespace vocalis::fsi
