// What the ends of a mesh reflect, 300 to 5000 Hz, and what they cost: plane waves at 0 and 45 degrees in the plane,
// and a monopole 0.1 m before the end. Each mesh is compared with one that goes on in the same cells, so that
// only the end counts. Cells of 7 mm: ten a wavelength at 5 kHz. With the release preset:
//   benchmark_reflections         the table of docs/validation.md
//   benchmark_reflections space   the monopole in space
//   benchmark_reflections study   cells of the layer and its `reflection`
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <complex>
#include <cstring>
#include <functional>
#include <numbers>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/pulse.hpp"
#include "core/base/mpi.hpp"
#include "core/base/session.hpp"
#include "core/mesh/generate.hpp"

namespace vocalis::acoustic {
namespace {

using std::numbers::pi;
using Spectra = std::vector<std::vector<std::complex<double>>>;  ///< (probes, frequencies)

constexpr double kCell = 7e-3;                                                // [m]
constexpr double kStep = 1.4e-5;                                              // [s]
const std::vector<double> kFrequencies = {300, 600, 1000, 2000, 3500, 5000};  // [Hz]

/// A box of cells.
struct Block {
  int dimension;
  std::array<int, 3> cells;
  std::array<double, 3> cell = {kCell, kCell, kCell};
};

mesh::Mesh build(const Block& block) {
  const int d = block.dimension;
  mesh::WholeMesh whole = mesh::box(
      MPI_COMM_WORLD, {1.0 * block.cells[0], 1.0 * block.cells[1], d == 3 ? 1.0 * block.cells[2] : 0.0}, block.cells);
  for (std::size_t v = 0; v < whole.coordinates.size(); v += d) {
    double* x = whole.coordinates.data() + v;
    for (int k = 0; k < d; ++k) x[k] *= block.cell[k];
  }
  return mesh::distribute(MPI_COMM_WORLD, whole);
}

AcousticSettings air() {
  AcousticSettings settings;
  settings.step = kStep;
  return settings;
}

struct Experiment {
  std::function<double(const double*)> source;  ///< share of the source at a vertex
  std::function<double(double)> pulse;
  std::vector<std::function<double(const double*)>> probes;  ///< weight of a vertex
  std::vector<double> frequencies = kFrequencies;
  double duration = 0;
};

struct Result {
  Spectra spectra;
  double milliseconds = 0;  ///< of a step
  std::int64_t vertices = 0;
};

Result run(const mesh::Mesh& mesh, const AcousticSettings& settings, const Experiment& experiment) {
  AcousticSolver solver(mesh, settings);
  fem::Load begin(solver.space(), 1), end(solver.space(), 1);
  std::vector<std::vector<std::pair<std::int32_t, double>>> weights(experiment.probes.size());
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (const double weight = experiment.probes[i](mesh.point(v)); weight != 0) weights[i].push_back({v, weight});
    }
  }
  std::vector<std::pair<std::int32_t, double>> shares;
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
    if (const double share = experiment.source(mesh.point(v)); share != 0) shares.push_back({v, share});
  }
  Result result;
  result.vertices = mesh.vertices.num_global;
  result.spectra.assign(weights.size(), std::vector<std::complex<double>>(experiment.frequencies.size()));
  const int steps = static_cast<int>(std::lround(experiment.duration / kStep));
  const auto start = std::chrono::steady_clock::now();
  for (int n = 0; n < steps; ++n) {
    for (const auto& [v, share] : shares) {
      begin.values[v] = share * experiment.pulse(n * kStep);
      end.values[v] = share * experiment.pulse((n + 1) * kStep);
    }
    const AdvanceReport report = solver.advance(kStep, {}, {&begin, &end, {}});
    if (!report.converged) fmt::print("not converged: {}\n", report.reason);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      double pressure = 0;
      for (const auto& [v, weight] : weights[i]) pressure += weight * solver.state().p[v];
      for (std::size_t f = 0; f < experiment.frequencies.size(); ++f) {
        result.spectra[i][f] += pressure * std::polar(1.0, -2 * pi * experiment.frequencies[f] * (n + 1) * kStep);
      }
    }
  }
  result.milliseconds = 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / steps;
  for (auto& spectrum : result.spectra) {
    MPI_Allreduce(MPI_IN_PLACE, spectrum.data(), static_cast<int>(spectrum.size()), MPI_C_DOUBLE_COMPLEX, MPI_SUM,
                  mesh.comm);
  }
  return result;
}

/// Largest |p - p_reference| / |p_reference| over the probes, at each frequency.
std::vector<double> differences(const Result& result, const Result& reference) {
  std::vector<double> largest(result.spectra[0].size(), 0.0);
  for (std::size_t i = 0; i < result.spectra.size(); ++i) {
    for (std::size_t f = 0; f < largest.size(); ++f) {
      const auto expected = reference.spectra[i][f];
      largest[f] = std::max(largest[f], std::abs(result.spectra[i][f] - expected) / std::abs(expected));
    }
  }
  return largest;
}

/// An end of the mesh: a condition at once, or a layer of so many cells.
struct End {
  std::string name;
  AcousticBoundaryKind kind = AcousticBoundaryKind::open;
  double radius = 0;
  int cells = 0;  ///< 0: no layer
  LayerKind layer = LayerKind::pml;
  double reflection = AbsorbingLayer{}.reflection;
};

AcousticSettings settings_with(const End& end, const std::vector<BoxSide>& sides,
                               const std::vector<std::string>& groups) {
  AcousticSettings settings = air();
  if (end.cells > 0) {
    settings.layers = {{end.layer, sides, end.cells * kCell, end.reflection}};
  } else {
    for (const std::string& group : groups) settings.boundaries.push_back({group, end.kind, 0, end.radius});
  }
  return settings;
}

struct Row {
  std::vector<double> reflections;
  double milliseconds = 0;
  std::int64_t vertices = 0;
};

/// A duct in which a wave goes at an angle: mode `mode` across it. Measured at the rigid wall where the source is, and
/// where an echo doubles.
class Duct {
 public:
  Duct(double frequency, double angle, double duration) : duration_(duration) {
    const double width = angle > 0 ? 350 / (2 * frequency * std::sin(angle)) : 6 * kCell;
    across_ = angle > 0 ? 16 : 6;
    height_ = width / across_;
    const double mode = angle > 0 ? pi / width : 0;
    const double tolerance = 1e-9;
    const double height = height_;
    const auto shape = [=](const double* x) {
      const bool edge = x[1] < tolerance || x[1] > width - tolerance;
      return x[0] < tolerance ? height * (edge ? 0.5 : 1) * std::cos(mode * x[1]) : 0;
    };
    experiment_.source = experiment_.probes.emplace_back(shape);
    experiment_.duration = duration;
    if (angle > 0) {
      experiment_.frequencies = {frequency};
      const double width_in_time = 1 / frequency;
      experiment_.pulse = [=](double t) {
        return std::exp(-0.5 * std::pow(t / width_in_time - 5, 2)) * std::sin(2 * pi * frequency * t);
      };
    } else {
      const GaussianFlux pulse({.amplitude = 1, .maximum_frequency = 6000});
      experiment_.pulse = [=](double t) { return pulse.value(t); };
    }
    reference_ = run(mesh(static_cast<int>(350 * duration / 2 / kCell) + 10), air(), experiment_);
  }
  Row measure(const End& end) const {
    const Result result = run(mesh(kInner + end.cells), settings_with(end, {BoxSide::x_max}, {"right"}), experiment_);
    Row row = {differences(result, reference_), result.milliseconds, result.vertices};
    for (double& value : row.reflections) value *= 0.5;
    return row;
  }

 private:
  static constexpr int kInner = 40;
  mesh::Mesh mesh(int cells) const { return build({2, {cells, across_, 0}, {kCell, height_, 0}}); }
  double duration_, height_ = 0;
  int across_ = 0;
  Experiment experiment_;
  Result reference_;
};

/// A monopole at the corner of three planes of symmetry; the end is at 14 cells on the three other sides. Measured on
/// the axes and diagonals 0.1 m from it.
class Monopole {
 public:
  explicit Monopole(int dimension) : dimension_(dimension) {
    const GaussianFlux pulse({.amplitude = 1e-5, .maximum_frequency = 6000});
    experiment_.source = [=](const double* x) {
      return std::hypot(x[0], x[1], dimension == 3 ? x[2] : 0) < 1e-9 ? 1.0 : 0.0;
    };
    experiment_.pulse = [=](double t) { return pulse.value(t); };
    experiment_.duration = 5e-3;
    const std::vector<std::array<int, 3>> points = {{14, 0, 0}, {0, 14, 0}, {10, 10, 0},
                                                    {8, 8, 8},  {0, 0, 14}, {0, 10, 10}};
    for (const auto& point : points) {
      if (dimension == 2 && point[2] > 0) continue;
      experiment_.probes.push_back([=](const double* x) {
        double square = 0;
        for (int k = 0; k < dimension; ++k) square += std::pow(x[k] / kCell - point[k], 2);
        return square < 0.1 ? 1.0 : 0.0;
      });
    }
    // In the plane the mesh goes on until no echo returns; in space, for twice the distance and a layer of 24 cells.
    AcousticSettings settings = air();
    if (dimension == 3) settings.layers = {{LayerKind::pml, sides(), 24 * kCell, 1e-5}};
    reference_ = run(mesh(dimension == 3 ? 2 * kInner + 24 : 140), settings, experiment_);
  }
  Row measure(const End& end) const {
    std::vector<std::string> groups = {"right", "top"};
    if (dimension_ == 3) groups.push_back("back");
    const Result result = run(mesh(kInner + end.cells), settings_with(end, sides(), groups), experiment_);
    return {differences(result, reference_), result.milliseconds, result.vertices};
  }

 private:
  static constexpr int kInner = 15;
  std::vector<BoxSide> sides() const {
    if (dimension_ == 2) return {BoxSide::x_max, BoxSide::y_max};
    return {BoxSide::x_max, BoxSide::y_max, BoxSide::z_max};
  }
  mesh::Mesh mesh(int cells) const { return build({dimension_, {cells, cells, cells}}); }
  int dimension_;
  Experiment experiment_;
  Result reference_;
};

void print(const std::string& name, const Row& row, double milliseconds_without) {
  std::string text;
  for (const double value : row.reflections) text += fmt::format(" {:.2f} |", 100 * value);
  fmt::print("| {} |{} {:.2f} | {} | {:.1f} |\n", name, text,
             100 * *std::max_element(row.reflections.begin(), row.reflections.end()), row.vertices,
             row.milliseconds / milliseconds_without);
  std::fflush(stdout);
}

/// The reflection at each frequency from a duct of its own.
Row at_45_degrees(const std::vector<Duct>& ducts, const End& end) {
  Row row;
  for (const Duct& duct : ducts) {
    const Row one = duct.measure(end);
    row.reflections.push_back(one.reflections[0]);
    row.milliseconds += one.milliseconds;
    row.vertices = one.vertices;
  }
  return row;
}

}  // namespace
}  // namespace vocalis::acoustic

int main(int argc, char** argv) {
  using namespace vocalis::acoustic;
  const vocalis::base::Session session(argc, argv);
  const bool is_study = argc > 1 && std::strcmp(argv[1], "study") == 0;
  const bool is_space = argc > 1 && std::strcmp(argv[1], "space") == 0;
  const End plane = {"plane, first order"}, sponge = {"sponge", {}, 0, 10, LayerKind::sponge};
  std::vector<End> ends = {plane};
  for (const int cells : {10, 20}) {
    ends.push_back(sponge);
    ends.back().cells = cells;
    ends.back().name = fmt::format("sponge, {} cells", cells);
  }
  for (const int cells : {6, 10, 16, 20}) ends.push_back({fmt::format("PML, {} cells", cells), {}, 0, cells});
  if (is_study) {
    ends = {plane};
    for (const int cells : {4, 6, 8, 10, 12, 16, 20}) {
      for (const double reflection : {1e-2, 1e-3, 1e-4, 1e-6}) {
        ends.push_back(
            {fmt::format("PML, {} cells, R0 = {:.0e}", cells, reflection), {}, 0, cells, LayerKind::pml, reflection});
      }
    }
  }
  std::string heads;
  for (const double frequency : kFrequencies) heads += fmt::format(" {} Hz |", frequency);
  const auto section = [&](const std::string& title, const std::function<Row(const End&)>& measure) {
    fmt::print("\n{}, reflection in per cent\n\n| end |{} largest | vertices | time of a step |\n", title, heads);
    double without = 0;
    for (const End& end : ends) {
      const Row row = measure(end);
      if (without == 0) without = row.milliseconds;
      print(end.name, row, without);
    }
  };
  if (is_space) {
    const Monopole monopole(3);
    section("monopole in space at 0.1 m", [&](const End& end) { return monopole.measure(end); });
    return 0;
  }
  const Duct straight(0, 0, 8e-3);
  section("plane wave at a right angle", [&](const End& end) { return straight.measure(end); });
  std::vector<Duct> oblique;
  for (const double frequency : kFrequencies)
    oblique.emplace_back(frequency, std::numbers::pi / 4, 12 / frequency + 2.5e-3);
  section("plane wave at 45 degrees", [&](const End& end) { return at_45_degrees(oblique, end); });
  const Monopole monopole(2);
  section("monopole in the plane at 0.1 m", [&](const End& end) { return monopole.measure(end); });
}
