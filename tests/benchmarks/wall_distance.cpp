// The distance from walls by the Eikonal equation, cold and beginning with the last one after the mesh has shrunk
// across by a tenth of a cell, beside the direct one: errors against the exact distance, over the largest, and seconds.
// Run with the release preset on 1 and 2 ranks:
//   mpirun -n 2 benchmark_wall_distance [-dimension 2] [-levels 4] [-corrections 2] [-irregular]
// With -irregular only the L-shape, its inner vertices moved by up to a fifth of a brick.
#include "contact/wall_distance.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>

#include "core/base/mpi.hpp"
#include "core/base/session.hpp"
#include "core/la/petsc.hpp"
#include "tests/contact/scenes.hpp"

namespace vocalis::contact {
namespace {

/// Largest and mean error over the largest distance. Collective.
std::array<double, 2> errors(const Scene& scene, const fem::Field& distance) {
  const fem::Space& space = *distance.space;
  const mesh::Mesh& mesh = *space.mesh;
  double largest = 0, sum = 0;
  for (std::int32_t dof = 0; dof < space.dofs.num_owned; ++dof) {
    const double exact = scene.distance(mesh.dimension, mesh.point(space.dof_vertex[dof]));
    const double error = std::abs(distance.values[dof] - exact) / scene.length;
    largest = std::max(largest, error);
    sum += error;
  }
  return {base::largest(mesh.comm, largest), base::sum(mesh.comm, sum) / static_cast<double>(space.dofs.num_global)};
}

/// Runs it three times; the shortest, in milliseconds. Collective.
template <class Run>
double milliseconds(MPI_Comm comm, Run run) {
  double shortest = 1e9;
  for (int repetition = 0; repetition < 3; ++repetition) {
    MPI_Barrier(comm);
    const double start = MPI_Wtime();
    run();
    shortest = std::min(shortest, base::largest(comm, MPI_Wtime() - start));
  }
  return 1e3 * shortest;
}

void measure(const Scene& scene, int dimension, int refinement, const EikonalSettings& settings, bool is_irregular) {
  SceneMesh built = build(scene, dimension, refinement);
  if (is_irregular) shake(built, refinement);
  const fem::Space space = built.space();
  const auto& points = built.mesh.coordinates;
  std::vector<double> moved = points;
  for (std::size_t i = 1; i < moved.size(); i += dimension) moved[i] *= 1 - 0.1 / (scene.cells[1] * refinement);
  Eikonal eikonal(space);
  EikonalReport cold, warm;
  WallDistance by_equation, directly;
  const double cold_time = milliseconds(built.mesh.comm, [&] {
    by_equation = eikonal_distance(eikonal, space, built.walls, points, {}, settings, {}, cold);
  });
  const double warm_time = milliseconds(built.mesh.comm, [&] {
    eikonal_distance(eikonal, space, built.walls, moved, {}, settings, by_equation.distance.values, warm);
  });
  const double direct_time = milliseconds(
      built.mesh.comm, [&] { directly = direct_distance(space, built.walls, points, {}, 10 * scene.length); });
  const double near_time =
      milliseconds(built.mesh.comm, [&] { direct_distance(space, built.walls, points, {}, 0.1 * scene.length); });
  const auto [largest, mean] = errors(scene, by_equation.distance);
  const auto [direct_largest, direct_mean] = errors(scene, directly.distance);
  if (base::rank(MPI_COMM_WORLD) != 0) return;
  fmt::print(
      "| {} | {} | {} | {:.4f}, {:.4f} | {} / {}, {:.1f} ms | {} / {}, {:.1f} ms{} | {:.0e}, {:.1f} ms | {:.1f} ms |\n",
      scene.name, dimension, space.dofs.num_global, largest, mean, cold.iterations, cold.linear_iterations, cold_time,
      warm.iterations, warm.linear_iterations, warm_time, cold.converged && warm.converged ? "" : " not converged",
      direct_largest, direct_time, near_time);
  std::fflush(stdout);
}

}  // namespace
}  // namespace vocalis::contact

int main(int argc, char** argv) {
  using namespace vocalis::contact;
  const vocalis::base::Session session(argc, argv);
  PetscInt dimension = 2, levels = 4, corrections = EikonalSettings{}.corrections;
  PetscBool is_irregular = PETSC_FALSE;
  vocalis::base::check(PetscOptionsGetInt(nullptr, nullptr, "-dimension", &dimension, nullptr));
  vocalis::base::check(PetscOptionsGetInt(nullptr, nullptr, "-levels", &levels, nullptr));
  vocalis::base::check(PetscOptionsGetInt(nullptr, nullptr, "-corrections", &corrections, nullptr));
  vocalis::base::check(PetscOptionsHasName(nullptr, nullptr, "-irregular", &is_irregular));
  const EikonalSettings settings{.corrections = static_cast<int>(corrections)};
  for (const Scene* scene : {&channel_scene, &discs_scene, &l_scene, &wedge_scene<5>, &gap_scene}) {
    for (int level = 0; level < levels && (!is_irregular || scene == &l_scene); ++level) {
      measure(*scene, dimension, (dimension == 3 ? 2 : 4) << level, settings, is_irregular);
    }
  }
  return 0;
}
