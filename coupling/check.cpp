#include "coupling/check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/log.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/geometry.hpp"
#include "coupling/balance.hpp"
#include "coupling/simulation.hpp"

namespace vocalis::coupling {

namespace {

// Seconds a step and unknown on one core of 2026, release preset, cases/vowel_i/quick.toml. The flow's direct solver
// runs on one rank and grows faster than the size: its figure is for some 20,000 unknowns in the plane.
constexpr double flow_seconds_per_unknown = 2.5e-6, acoustic_seconds_per_unknown = 3.5e-7;
// Bytes an unknown: matrix, factors, vectors.
constexpr double flow_bytes_per_unknown = 6000, acoustic_bytes_per_unknown = 1000;

void say_balance(base::Log& log, const std::string& solver, const mesh::Mesh& mesh) {
  const Balance found = balance(mesh);
  if (found.ranks > 1) {
    log.info("#     up to {} cells a rank, {:.1f} % above the mean", found.largest_share, 100 * found.imbalance());
  }
  const std::string words = advice(solver, found);
  if (!words.empty()) log.info("#     NOTE: {}", words);
}

}  // namespace

int check(MPI_Comm comm, const Command& command) {
  const Case config = read_case(comm, command.target, command.overrides);
  base::Log log(comm);
  log.info("{}", config.resolved);
  auto scene = build_scene(comm, config);
  base::Timers timers;
  Simulation simulation(*scene, config, timers);

  const double steps = std::ceil(config.time.end / config.time.step);
  double seconds = 0, bytes = 0;
  log.info("# {}: a mesh of {} cells and {} vertices in {} dimensions, smallest quality {:.3f}", config.name,
           scene->parent.cells.num_global, scene->parent.vertices.num_global, scene->parent.dimension,
           mesh::smallest_quality(scene->parent));
  if (simulation.flow()) {
    const double unknowns = static_cast<double>(simulation.flow()->num_unknowns());
    log.info("#   flow: {} cells, {:.0f} unknowns, {:.0f} steps of {:.3g} s", scene->flow->mesh.cells.num_global,
             unknowns, steps, config.time.step);
    say_balance(log, "the flow", scene->flow->mesh);
    seconds += steps * unknowns * flow_seconds_per_unknown;
    bytes += unknowns * flow_bytes_per_unknown;
  }
  if (config.given_flow) log.info("#   flow: {} cells, given: nothing to solve", scene->flow->mesh.cells.num_global);
  for (std::size_t i = 0; i < config.acoustics.size(); ++i) {
    const acoustic::AcousticSettings& settings = config.acoustics[i];
    const Voice& voice = *simulation.voices()[i];
    const double unknowns = 2.0 * static_cast<double>(voice.mesh().vertices.num_global);
    const double sub_steps = steps * std::ceil(config.time.step / settings.step - 1e-9);
    log.info("#   {}: {} cells, {:.0f} unknowns, {:.0f} steps", settings.name, voice.mesh().cells.num_global, unknowns,
             sub_steps);
    log.info("#     {}", voice.integrator_words());
    say_balance(log, settings.name, voice.mesh());
    if (const transfer::PointsOutside* outside = voice.flow_outside(); outside && outside->count > 0) {
      log.info("#     a mesh of its own: {} vertices of the flow lie outside of it, up to {:.3g} m ({:.2g} of a cell)",
               outside->count, outside->distance, outside->cells);
    }
    seconds += sub_steps * unknowns * acoustic_seconds_per_unknown / base::size(comm);
    bytes += unknowns * acoustic_bytes_per_unknown;
  }
  log.info("#   about {:.2g} GB of memory, and {} on {} ranks: an estimate, good to a factor of two or three",
           (bytes + 1e8 * base::size(comm)) / 1e9, base::duration_words(seconds), base::size(comm));
  log.info("# the case is sound; nothing was solved");
  return 0;
}

}  // namespace vocalis::coupling
