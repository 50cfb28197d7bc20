// Waves from a source to probes, on blocks of even cells: what benchmark_reflections does again and again.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <ctime>
#include <functional>
#include <numbers>
#include <vector>

#include "acoustic_solver/acoustic_solver.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"

namespace vocalis::acoustic::benchmark {

using Spectra = std::vector<std::vector<std::complex<double>>>;  ///< (probes, frequencies)

inline constexpr double kCell = 7e-3;                                                // [m]
inline constexpr double kStep = 1.4e-5;                                              // [s]
inline const std::vector<double> kFrequencies = {300, 600, 1000, 2000, 3500, 5000};  // [Hz]

/// A box of cells from the origin, or the ball in which its layers of cells about the origin are spheres.
struct Block {
  int dimension;
  std::array<int, 3> cells;
  std::array<double, 3> cell = {kCell, kCell, kCell};
  int cells_below = 0;  ///< so many of the cells along x have x < 0
  bool is_ball = false;
};

/// Collective.
inline mesh::Mesh build(const Block& block) {
  const int d = block.dimension;
  mesh::WholeMesh whole = mesh::box(
      MPI_COMM_WORLD, {1.0 * block.cells[0], 1.0 * block.cells[1], d == 3 ? 1.0 * block.cells[2] : 0.0}, block.cells);
  for (std::size_t v = 0; v < whole.coordinates.size(); v += d) {
    double* x = whole.coordinates.data() + v;
    x[0] -= block.cells_below;
    double square = 0, largest = 0;
    for (int k = 0; k < d; ++k) {
      square += x[k] * x[k];
      largest = std::max(largest, std::abs(x[k]));
    }
    const double bend = block.is_ball && square > 0 ? largest / std::sqrt(square) : 1;
    for (int k = 0; k < d; ++k) x[k] *= bend * block.cell[k];
  }
  return mesh::distribute(MPI_COMM_WORLD, whole);
}

/// A source that follows a pulse, and what is read at the probes.
struct Experiment {
  std::function<double(const double*)> source;  ///< share of the source at a vertex
  std::function<double(double)> pulse;
  std::vector<std::function<double(const double*)>> probes;  ///< weight of a vertex
  std::vector<double> frequencies = kFrequencies;
  double duration = 0;  ///< [s]
  double step = kStep;  ///< [s]
};

struct Result {
  Spectra spectra;
  double milliseconds = 0;  ///< of the processor, a step after the first
  double iterations = 0;    ///< of the linear solver, a step
  std::int64_t vertices = 0;
};

/// From silence on; spectra at the frequencies, over the whole duration. Collective.
inline Result run(const mesh::Mesh& mesh, AcousticSettings settings, const Experiment& experiment) {
  const double dt = settings.step = experiment.step;
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
  const int steps = static_cast<int>(std::lround(experiment.duration / dt));
  std::clock_t start = 0;
  for (int n = 0; n < steps; ++n) {
    if (n == 1) start = std::clock();
    for (const auto& [v, share] : shares) {
      begin.values[v] = share * experiment.pulse(n * dt);
      end.values[v] = share * experiment.pulse((n + 1) * dt);
    }
    const AdvanceReport report = solver.advance(dt, {}, {&begin, &end, {}});
    if (!report.converged) fmt::print("not converged: {}\n", report.reason);
    result.iterations += 1.0 * report.linear_iterations / steps;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      double pressure = 0;
      for (const auto& [v, weight] : weights[i]) pressure += weight * solver.state().p[v];
      for (std::size_t f = 0; f < experiment.frequencies.size(); ++f) {
        result.spectra[i][f] +=
            pressure * std::polar(1.0, -2 * std::numbers::pi * experiment.frequencies[f] * (n + 1) * dt);
      }
    }
  }
  result.milliseconds = 1e3 * (std::clock() - start) / CLOCKS_PER_SEC / (steps - 1);
  for (auto& spectrum : result.spectra) {
    MPI_Allreduce(MPI_IN_PLACE, spectrum.data(), static_cast<int>(spectrum.size()), MPI_C_DOUBLE_COMPLEX, MPI_SUM,
                  mesh.comm);
  }
  return result;
}

/// Largest |p - p_reference| / |p_reference| over the probes, at each frequency.
inline std::vector<double> differences(const Result& result, const Result& reference) {
  std::vector<double> largest(result.spectra[0].size(), 0.0);
  for (std::size_t i = 0; i < result.spectra.size(); ++i) {
    for (std::size_t f = 0; f < largest.size(); ++f) {
      const auto expected = reference.spectra[i][f];
      largest[f] = std::max(largest[f], std::abs(result.spectra[i][f] - expected) / std::abs(expected));
    }
  }
  return largest;
}

}  // namespace vocalis::acoustic::benchmark
