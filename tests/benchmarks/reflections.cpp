// What the ends of a mesh reflect, 300 to 5000 Hz: plane waves at 0 and 45 degrees, and a monopole 0.1 m before the
// end, in the plane and in space. Each mesh is compared with one that goes on in the same cells, so that only the end
// counts. Cells of 7 mm: ten a wavelength at 5 kHz. With the release preset:
//   benchmark_reflections plane > plane.csv   waves in the plane, layers of many thicknesses and strengths
//   benchmark_reflections space > space.csv   a monopole in space
//   benchmark_reflections cost                seconds of a step with and without layers
// draw_reflections.py makes the tables and the chart of docs/validation.md of them.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "acoustic_solver/pulse.hpp"
#include "core/base/session.hpp"
#include "tests/benchmarks/experiment.hpp"

namespace vocalis::acoustic {
namespace {

using namespace benchmark;
using std::numbers::pi;

/// An end of the mesh: a condition at once, or a layer of so many cells.
struct End {
  std::string name;
  double radius = 0;  ///< of the open condition [m]; 0: plane
  int cells = 0;      ///< 0: no layer
  LayerKind layer = LayerKind::pml;
  double reflection = AbsorbingLayer{}.reflection;
};

End pml(int cells, double reflection) { return {"PML", 0, cells, LayerKind::pml, reflection}; }

std::vector<End> ends_of_study(const std::vector<int>& cells, const std::vector<double>& reflections) {
  std::vector<End> ends = {{"plane, first order"}};
  for (const int count : {10, 20}) ends.push_back({"sponge", 0, count, LayerKind::sponge});
  for (const int count : cells) {
    for (const double reflection : reflections) ends.push_back(pml(count, reflection));
  }
  return ends;
}

AcousticSettings settings_with(const End& end, const std::vector<BoxSide>& sides,
                               const std::vector<std::string>& groups) {
  AcousticSettings settings;
  if (end.cells > 0) {
    settings.layers = {{end.layer, sides, end.cells * kCell, end.reflection}};
  } else {
    for (const auto& group : groups) settings.boundaries.push_back({group, AcousticBoundaryKind::open, 0, end.radius});
  }
  return settings;
}

void print(const std::string& waves, const End& end, const std::vector<double>& frequencies, const Result& result,
           const std::vector<double>& reflections) {
  for (std::size_t f = 0; f < frequencies.size(); ++f) {
    const std::string strength = end.cells > 0 ? fmt::format("{:.0e}", end.reflection) : "";
    fmt::print("{};{};{};{};{};{:.4f};{};{:.4f}\n", waves, end.name, end.cells, strength, frequencies[f],
               100 * reflections[f], result.vertices, result.milliseconds);
  }
  std::fflush(stdout);
}

/// A duct in which a wave goes at an angle: the first mode across it. Measured at the rigid wall where the source is,
/// and where an echo doubles.
class Duct {
 public:
  /// A pulse of plane waves.
  Duct() {
    const GaussianFlux pulse({.amplitude = 1, .maximum_frequency = 6000});
    experiment_.pulse = [=](double t) { return pulse.value(t); };
    experiment_.duration = 8e-3;
    begin(0);
  }
  /// Waves at 45 degrees: a burst of 2.5 periods' standard deviation, which has little at the cut-on frequency of the
  /// mode, 0.7 of its own, where waves graze the end and hardly move.
  explicit Duct(double frequency) {
    width_ = 350 / (2 * frequency * std::sin(pi / 4));
    cells_across_ = 12;
    experiment_.frequencies = {frequency};
    experiment_.step = 0.04 / frequency;
    experiment_.pulse = [=](double t) {
      return std::exp(-0.5 * std::pow((t * frequency - 11) / 2.5, 2)) * std::sin(2 * pi * frequency * t);
    };
    experiment_.duration = 26 / frequency + 2 * 3e-3;
    begin(pi / width_);
  }
  void measure(const std::string& waves, const End& end) const {
    const Result result = run(mesh(kInner + end.cells), settings_with(end, {BoxSide::x_max}, {"right"}), experiment_);
    std::vector<double> reflections = differences(result, reference_);
    for (double& value : reflections) value *= 0.5;
    print(waves, end, experiment_.frequencies, result, reflections);
  }

 private:
  static constexpr int kInner = 40;
  void begin(double mode) {
    const double tolerance = 1e-9, width = width_, height = width_ / cells_across_;
    const auto shape = [=](const double* x) {
      const bool edge = x[1] < tolerance || x[1] > width - tolerance;
      return x[0] < tolerance ? height * (edge ? 0.5 : 1) * std::cos(mode * x[1]) : 0;
    };
    experiment_.source = experiment_.probes.emplace_back(shape);
    reference_ = run(mesh(static_cast<int>(350 * experiment_.duration / 2 / kCell) + 10), {}, experiment_);
  }
  mesh::Mesh mesh(int cells) const { return build({2, {cells, cells_across_, 0}, {kCell, width_ / cells_across_, 0}}); }
  double width_ = 6 * kCell;
  int cells_across_ = 6;
  Experiment experiment_;
  Result reference_;
};

/// A monopole at planes of symmetry, in a box or a ball that ends 15 cells from its middle. Measured on axes and
/// diagonals 0.1 m from there.
class Monopole {
 public:
  /// offset  of the monopole from the middle of a ball, in cells along x
  explicit Monopole(int dimension, bool is_ball = false, int offset = 0)
      : dimension_(dimension), is_ball_(is_ball), offset_(offset) {
    const GaussianFlux pulse({.amplitude = 1e-5, .maximum_frequency = 6000});
    experiment_.pulse = [=](double t) { return pulse.value(t); };
    experiment_.source = at({1.0 * offset, 0, 0});
    std::vector<std::array<double, 3>> points = {{14, 0, 0}, {0, 14, 0}, {10, 10, 0}};
    if (is_ball) points[2] = {14 * std::sqrt(0.5), 14 * std::sqrt(0.5), 0};
    if (offset > 0) points.push_back({-14, 0, 0});
    if (dimension == 3 && !is_ball) points.insert(points.end(), {{8, 8, 8}, {0, 0, 14}, {0, 10, 10}});
    for (const auto& point : points) experiment_.probes.push_back(at(point));
    // In space silence follows the pulse: the reference ends before its first echo. In the plane nothing is ever over.
    AcousticSettings settings;
    const int cells = dimension == 3 ? 35 : 130;
    if (dimension == 2 && is_ball) settings = settings_with({"", cells * kCell}, {}, {"right", "top"});
    if (dimension == 2 && !is_ball) settings.layers = {{LayerKind::pml, sides(), 30 * kCell, 1e-5}};
    experiment_.duration = dimension == 3 ? 1.15e-3 : 12e-3;
    reference_ = run(mesh(cells), settings, experiment_);
    experiment_.duration = dimension == 3 ? 4e-3 : 12e-3;
  }
  void measure(const std::string& waves, const End& end) const {
    const Result result = run_with(end, experiment_);
    print(waves, end, experiment_.frequencies, result, differences(result, reference_));
  }
  /// 60 steps with this layer, or without it in as much air.
  Result begin(const End& end, bool has_layer) const {
    Experiment experiment = experiment_;
    experiment.duration = 60 * kStep;
    return has_layer ? run_with(end, experiment) : run(mesh(kInner + end.cells), {}, experiment);
  }

 private:
  static constexpr int kInner = 15;
  Result run_with(const End& end, const Experiment& experiment) const {
    std::vector<std::string> groups = {"right", "top"};
    if (dimension_ == 3) groups.push_back("back");
    if (offset_ > 0) groups.push_back("left");
    return run(mesh(kInner + end.cells), settings_with(end, sides(), groups), experiment);
  }
  /// 1 at the vertex of these coordinates in cells.
  std::function<double(const double*)> at(const std::array<double, 3>& point) const {
    return [=, dimension = dimension_](const double* x) {
      double square = 0;
      for (int k = 0; k < dimension; ++k) square += std::pow(x[k] / kCell - point[k], 2);
      return square < 0.05 ? 1.0 : 0.0;
    };
  }
  std::vector<BoxSide> sides() const {
    if (dimension_ == 2) return {BoxSide::x_max, BoxSide::y_max};
    return {BoxSide::x_max, BoxSide::y_max, BoxSide::z_max};
  }
  mesh::Mesh mesh(int cells) const {
    const int below = offset_ > 0 ? cells : 0;
    return build({dimension_, {cells + below, cells, cells}, {kCell, kCell, kCell}, below, is_ball_});
  }
  int dimension_;
  bool is_ball_;
  int offset_;
  Experiment experiment_;
  Result reference_;
};

void study_plane() {
  const std::vector<End> ends = ends_of_study({4, 6, 8, 10, 12, 16, 20, 24}, {1e-2, 1e-3, 1e-4, 3e-5, 1e-5});
  const Duct straight;
  for (const End& end : ends) straight.measure("0 degrees", end);
  for (const double frequency : kFrequencies) {
    const Duct oblique(frequency);
    for (const End& end : ends) oblique.measure("45 degrees", end);
  }
  const Monopole monopole(2), centre(2, true);
  for (const End& end : ends) monopole.measure("monopole in the plane", end);
  for (const double radius : {0.0, 15 * kCell}) {
    centre.measure("monopole in a disc", {radius > 0 ? "spherical, first order" : "plane, first order", radius});
  }
}

void study_space() {
  for (const int offset : {0, 5}) {
    const Monopole ball(3, true, offset);
    for (const double radius : {0.0, 15 * kCell}) {
      ball.measure(offset > 0 ? "monopole off the centre of a ball" : "monopole in a ball",
                   {radius > 0 ? "spherical, first order" : "plane, first order", radius});
    }
  }
  const Monopole monopole(3);
  for (const End& end : ends_of_study({10, 12, 16, 20, 24}, {1e-3, 1e-4})) monopole.measure("monopole in space", end);
}

/// The least of five rounds, since other programs disturb.
void measure_cost() {
  const std::vector<End> ends = {
      {"nothing"}, {"sponge", 0, 16, LayerKind::sponge}, pml(10, 1e-3), pml(16, 1e-3), pml(24, 1e-3)};
  for (const int dimension : {2, 3}) {
    const Monopole monopole(dimension);
    std::vector<std::array<Result, 2>> least(ends.size());
    for (int round = 0; round < 5; ++round) {
      for (std::size_t i = 0; i < ends.size(); ++i) {
        for (const bool has_layer : {false, true}) {
          Result result = monopole.begin(ends[i], has_layer);
          Result& best = least[i][has_layer];
          if (round == 0 || result.milliseconds < best.milliseconds) best = std::move(result);
        }
      }
    }
    fmt::print("\n{} dimensions | vertices | ms, iterations a step | in as much air without it\n", dimension);
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const auto& [air, layer] = least[i];
      fmt::print("{}, {} cells | {} | {:.3f}, {:.1f} | {:.3f}, {:.1f}\n", ends[i].name, ends[i].cells, layer.vertices,
                 layer.milliseconds, layer.iterations, air.milliseconds, air.iterations);
    }
  }
}

}  // namespace
}  // namespace vocalis::acoustic

int main(int argc, char** argv) {
  const vocalis::base::Session session(argc, argv);
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "cost") {
    vocalis::acoustic::measure_cost();
  } else if (what == "plane" || what == "space") {
    fmt::print("waves;end;cells;R0;frequency;percent;vertices;milliseconds\n");
    what == "plane" ? vocalis::acoustic::study_plane() : vocalis::acoustic::study_space();
  } else {
    fmt::print("benchmark_reflections plane | space | cost\n");
    return 2;
  }
}
