// Processor time of far-field microphones beside that of the implicit sub-step that they listen to, on half balls of
// air before a baffle. Run with the release preset:  mpirun -n 1 benchmark_far_field
#include <fmt/format.h>

#include <cmath>
#include <ctime>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/microphones.hpp"
#include "core/base/mpi.hpp"
#include "core/base/session.hpp"
#include "tests/acoustic_solver/balls.hpp"

namespace vocalis::acoustic {
namespace {

constexpr double radius = 0.1, speed = 350;
constexpr int sub_steps = 40, microphones = 4;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void measure(int cells) {
  const mesh::Mesh mesh = test::ball(radius, cells, true);
  AcousticSettings settings;
  settings.step = radius / cells / speed;
  settings.boundaries = {{"open", AcousticBoundaryKind::open, 0, radius}, {"piston", AcousticBoundaryKind::flux}};
  AcousticSolver solver(mesh, settings);
  std::vector<MicrophoneSettings> there;
  for (int m = 0; m < microphones; ++m) {
    there.push_back({fmt::format("m{}", m), {0, 0.1 * m, 1}, MicrophoneKind::far_field, "open", {{2, 0}}});
  }
  Microphones listening(mesh, there, {speed, settings.step, {}});
  double heard = 0;
  const double begin = processor_seconds();
  solver.advance(sub_steps * settings.step, {}, {nullptr, nullptr, [](double t) { return std::sin(1e4 * t); }},
                 [&](double time) {
                   const double start = processor_seconds();
                   listening.sample(time, solver.state().p);
                   heard += processor_seconds() - start;
                 });
  const double whole = processor_seconds() - begin;
  if (base::rank(mesh.comm) != 0) return;
  fmt::print("| {} | {} | {:.3f} | {:.2f} | {:.1f} % |\n", mesh.vertices.num_global, mesh.cells.num_global,
             1e3 * heard / sub_steps / microphones, 1e3 * (whole - heard) / sub_steps,
             100 * heard / microphones / (whole - heard));
}

}  // namespace
}  // namespace vocalis::acoustic

int main(int argc, char** argv) {
  const vocalis::base::Session session(argc, argv);
  if (vocalis::base::rank(MPI_COMM_WORLD) == 0) {
    fmt::print("| vertices | cells | ms a far-field microphone and sub-step | ms a sub-step | part |\n");
    fmt::print("| ---: | ---: | ---: | ---: | ---: |\n");
  }
  for (const int cells : {16, 32}) vocalis::acoustic::measure(cells);
}
