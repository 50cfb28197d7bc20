// How much of the memory's bandwidth the explicit step of sound in space reaches. The bandwidth is that of a triad
// a = b + s c on all ranks at once, in turns with the steps, counted as STREAM does: 24 bytes an element (McCalpin
// 1995). Medians of fifteen turns each.
// A sub-step counts what it must move: matrices, columns and each vector once a sweep. Run with the release preset:
//   mpirun -n 2 benchmark_explicit_bandwidth [cells along an edge]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <random>

#include "acoustic_solver/explicit_step.hpp"
#include "core/base/mpi.hpp"
#include "core/base/session.hpp"
#include "core/mesh/generate.hpp"

namespace vocalis::acoustic {
namespace {

/// Cells of unequal shapes, vertices numbered at random: the worst that a mesh generator can do.
mesh::Mesh build(int cells) {
  mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, {1, 1, 1}, {cells, cells, cells});
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> shift(-0.1 / cells, 0.1 / cells);
  for (double& x : whole.coordinates) x += x > 0 && x < 1 ? shift(generator) : 0;
  std::vector<std::int32_t> number(whole.coordinates.size() / 3);
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), generator);
  std::vector<double> coordinates(whole.coordinates.size());
  for (std::size_t v = 0; v < number.size(); ++v) {
    std::copy_n(whole.coordinates.begin() + static_cast<std::ptrdiff_t>(3 * v), 3,
                coordinates.begin() + static_cast<std::ptrdiff_t>(3) * number[v]);
  }
  whole.coordinates = coordinates;
  for (auto& v : whole.cell_vertices) v = number[v];
  for (auto& v : whole.facet_vertices) v = number[v];
  return mesh::distribute(MPI_COMM_WORLD, whole);
}

/// [s], of the slowest rank.
template <class Work>
double seconds(Work&& work) {
  MPI_Barrier(MPI_COMM_WORLD);
  const auto start = std::chrono::steady_clock::now();
  work();
  return base::largest(MPI_COMM_WORLD, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

struct Triad {
  explicit Triad(std::size_t size) : a(size, 1), b(size, 2), c(size, 3) {}
  void operator()() {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = b[i] + 0.5 * c[i];
    std::swap(a, b);
  }
  std::vector<double> a, b, c;
};

}  // namespace
}  // namespace vocalis::acoustic

int main(int argc, char** argv) {
  using namespace vocalis;
  const base::Session session(argc, argv);
  const mesh::Mesh mesh = acoustic::build(argc > 1 ? std::atoi(argv[1]) : 74);
  acoustic::AcousticSettings settings;
  settings.step = 1;
  const fem::Space space = fem::lagrange(mesh, 1);
  const acoustic::WaveOperator wave(mesh, space, settings);
  acoustic::ExplicitStep integrator(mesh, space, wave, settings.density);
  acoustic::SubStep step;
  constexpr int kParts = 10;
  step.dt = 0.9 * kParts * integrator.stable_step(false);
  acoustic::State state;
  state.p.assign(mesh.num_vertices(), 1.0);
  state.psi.assign(mesh.num_vertices(), 0.0);
  acoustic::AdvanceReport report;
  acoustic::Triad triad(30'000'000 / base::size(mesh.comm));
  const double triad_bytes = base::sum(mesh.comm, 24.0 * static_cast<double>(triad.a.size()));
  const double step_bytes = base::sum(mesh.comm, integrator.still().bytes_of_a_sub_step());
  std::vector<double> of_triads, of_steps;
  for (int round = 0; round < 15; ++round) {
    of_triads.push_back(acoustic::seconds(triad));
    of_steps.push_back(acoustic::seconds([&] { integrator.advance(step, kParts, state, report); }) / kParts);
  }
  const double triad_seconds = acoustic::median(of_triads), step_seconds = acoustic::median(of_steps);
  const double of_triad = triad_bytes / triad_seconds / 1e9, of_step = step_bytes / step_seconds / 1e9;
  const double least_triad = *std::min_element(of_triads.begin(), of_triads.end());
  const double least_step = *std::min_element(of_steps.begin(), of_steps.end());
  if (base::rank(mesh.comm) == 0) {
    fmt::print(
        "{} vertices on {} ranks: triad {:.2f} GB/s; sub-step {:.2f} ms, {:.0f} bytes and {:.1f} ns a vertex, "
        "{:.2f} GB/s: {:.0f} % of the triad's; of the least times {:.0f} %\n",
        mesh.vertices.num_global, base::size(mesh.comm), of_triad, 1e3 * step_seconds,
        step_bytes / static_cast<double>(mesh.vertices.num_global),
        1e9 * step_seconds / static_cast<double>(mesh.vertices.num_global), of_step, 100 * of_step / of_triad,
        100 * (step_bytes / least_step) / (triad_bytes / least_triad));
  }
}
