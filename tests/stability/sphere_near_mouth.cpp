#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/sources/gaussian_pulse.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

constexpr double kFrequency = 300;     ///< that of F1 of closed vowels [Hz]
constexpr double kRadius = 0.1;        ///< where the mesh ends, or a layer begins [m]
constexpr double kCell = kRadius / 8;  // [m]
constexpr double kStep = 2.5e-5;       // [s]

/// An octant of space about a mouth, a point: a cube, or the ball in which its layers of cells are spheres.
mesh::Mesh octant(int cells, bool is_ball) {
  const double edge = cells * kCell;
  mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, {edge, edge, edge}, {cells, cells, cells});
  for (std::size_t i = 0; is_ball && i < whole.coordinates.size(); i += 3) {
    double* x = whole.coordinates.data() + i;
    const double length = std::hypot(x[0], x[1], x[2]);
    const double largest = std::max({x[0], x[1], x[2]});
    for (int k = 0; k < 3 && length > 0; ++k) x[k] *= largest / length;
  }
  return mesh::distribute(MPI_COMM_WORLD, whole);
}

/// Pressure 0.1 m from the mouth at that frequency, of a pulse of volume.
Complex pressure(const mesh::Mesh& mesh, AcousticSettings settings, double duration) {
  settings.step = kStep;
  AcousticSolver solver(mesh, settings);
  const GaussianFlux pulse({.amplitude = 1e-4, .maximum_frequency = 5000});
  fem::Load begin(solver.space(), 1), end(solver.space(), 1);
  Complex sum = 0;
  for (int n = 0; n * kStep < duration; ++n) {
    for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
      const double* x = mesh.point(v);
      if (std::hypot(x[0], x[1], x[2]) > 0) continue;
      begin.values[v] = pulse.value(n * kStep);
      end.values[v] = pulse.value((n + 1) * kStep);
    }
    REQUIRE_ON_ALL_RANKS(solver.advance(kStep, {}, {&begin, &end, {}}).converged);
    for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
      const double* x = mesh.point(v);
      if (std::hypot(x[0] - kRadius, x[1], x[2]) > 1e-9) continue;
      sum += solver.state().p[v] * std::polar(1.0, -2 * pi * kFrequency * (n + 1) * kStep);
    }
  }
  return {base::sum(mesh.comm, sum.real()), base::sum(mesh.comm, sum.imag())};
}

/// Amplitude of the wave that comes back over that of the wave that leaves. What an end adds to the pressure in the
/// open is regular at the mouth: a multiple of (exp(ikr) - exp(-ikr)) / r.
double reflection(Complex with_end, Complex in_the_open, double wave_number) {
  const Complex phase = std::polar(1.0, wave_number * kRadius);
  const Complex back = (with_end - in_the_open) / (phase - 1.0 / phase);
  return std::abs(back / (in_the_open * phase - back));
}

AcousticSettings open_end(double radius) {
  AcousticSettings settings;
  for (const char* group : {"right", "top", "back"}) {
    settings.boundaries.push_back({group, AcousticBoundaryKind::open, 0, radius});
  }
  return settings;
}

}  // namespace

TEST_CASE("a plane open end near the mouth throws the sound of F1 back; a spherical one or a layer does not",
          "[serial]") {
  const double wave_number = 2 * pi * kFrequency / AcousticSettings{}.speed_of_sound;
  // In space silence follows the pulse: the meshes in the open are rigid, and no echo of theirs is waited for.
  constexpr double before_echo = 1.4e-3, duration = 5e-3;
  constexpr int far = 22, near = 8, layer = 16;
  const Complex in_open_ball = pressure(octant(far, true), {}, before_echo);
  const auto of_end = [&](double radius) {
    return reflection(pressure(octant(near, true), open_end(radius), duration), in_open_ball, wave_number);
  };
  AcousticSettings with_layer;
  AbsorbingLayer pml;
  pml.sides = {BoxSide::x_max, BoxSide::y_max, BoxSide::z_max};
  pml.thickness = layer * kCell;
  with_layer.layers = {pml};
  const double of_layer = reflection(pressure(octant(near + layer, false), with_layer, duration),
                                     pressure(octant(far, false), {}, before_echo), wave_number);
  const double plane = of_end(0), spherical = of_end(kRadius);
  UNSCOPED_INFO("plane " << plane << ", spherical " << spherical << ", layer " << of_layer);
  // Of the condition u·n = p / (ρ c) on a sphere: 0.68.
  CHECK(std::abs(plane - 1 / std::sqrt(1 + 4 * std::pow(wave_number * kRadius, 2))) < 0.02);
  CHECK(spherical < 0.01);
  CHECK(of_layer < 0.01);
}

}  // namespace vocalis::acoustic
