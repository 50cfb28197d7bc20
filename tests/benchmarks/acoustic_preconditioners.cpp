// Iterations and processor time of the implicit sub-step of sound by preconditioner, on horns whose cells grow tenfold
// from the glottis to the open air, under refinement and at several Courant numbers c dt / h of the coarsest cells (of
// the smallest: ten times as much). Run with the release preset, on 1 to 8 ranks:
//   mpirun -n 2 benchmark_acoustic_preconditioners [-dimension 3] [-first 0] [-levels 3] [-choices 9] [-steps 20]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/pulse.hpp"
#include "core/base/mpi.hpp"
#include "core/base/session.hpp"
#include "core/la/petsc.hpp"
#include "core/mesh/generate.hpp"

namespace vocalis::acoustic {
namespace {

constexpr double kSpeed = 350;

struct Choice {
  std::string name;
  std::vector<std::string> options;  ///< PETSc's, key and value in turn
};

const std::vector<Choice> choices = {
    {"shipped", {}},
    {"Jacobi", {"-acoustic_pc_type", "jacobi"}},
    {"symmetric Gauss-Seidel of a rank's block", {"-acoustic_pc_type", "sor"}},
    {"Chebyshev-Jacobi, degree 4",
     {"-acoustic_pc_type", "ksp", "-acoustic_ksp_ksp_type", "chebyshev", "-acoustic_ksp_ksp_max_it", "4",
      "-acoustic_ksp_ksp_norm_type", "none", "-acoustic_ksp_pc_type", "jacobi"}},
    {"ICC(0) of a rank's block", {"-acoustic_sub_pc_type", "icc"}},
    {"ICC(1) of a rank's block", {"-acoustic_sub_pc_type", "icc", "-acoustic_sub_pc_factor_levels", "1"}},
    {"Cholesky of a rank's block", {"-acoustic_sub_pc_type", "cholesky"}},
    {"BoomerAMG, HMIS, ext+i, Chebyshev",
     {"-acoustic_pc_type", "hypre", "-acoustic_pc_hypre_boomeramg_coarsen_type", "HMIS",
      "-acoustic_pc_hypre_boomeramg_interp_type", "ext+i", "-acoustic_pc_hypre_boomeramg_P_max", "4",
      "-acoustic_pc_hypre_boomeramg_strong_threshold", "0.25", "-acoustic_pc_hypre_boomeramg_relax_type_all",
      "Chebyshev"}},
    {"the same, aggressive along two paths",
     {"-acoustic_pc_type", "hypre", "-acoustic_pc_hypre_boomeramg_coarsen_type", "HMIS",
      "-acoustic_pc_hypre_boomeramg_interp_type", "ext+i", "-acoustic_pc_hypre_boomeramg_P_max", "4",
      "-acoustic_pc_hypre_boomeramg_strong_threshold", "0.25", "-acoustic_pc_hypre_boomeramg_relax_type_all",
      "Chebyshev", "-acoustic_pc_hypre_boomeramg_agg_nl", "1", "-acoustic_pc_hypre_boomeramg_agg_num_paths", "2"}}};

/// Bricks in layers, each cut into cells and a little shifted; h goes from coarsest / 10 to coarsest [m].
mesh::Mesh horn(int dimension, int level, double coarsest) {
  const int across = (dimension == 3 ? 8 : 20) << level, layers = (dimension == 3 ? 78 : 380) << level;
  mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, {1.0 * layers, 1.0 * across, dimension == 3 ? 1.0 * across : 0.0},
                                    {layers, across, across});
  const double growth = std::log(10.0) / layers;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> shift(-0.15, 0.15);
  for (std::size_t v = 0; v < whole.coordinates.size(); v += dimension) {
    double* x = whole.coordinates.data() + v;
    bool inside = x[0] > 0.5 && x[0] < layers - 0.5;
    for (int k = 1; k < dimension; ++k) inside = inside && x[k] > 0.5 && x[k] < across - 0.5;
    for (int k = 0; k < dimension; ++k) x[k] += inside ? shift(generator) : 0;
    const double h = coarsest / 10 * std::exp(growth * x[0]);
    x[0] = (h - coarsest / 10) / growth;
    for (int k = 1; k < dimension; ++k) x[k] = h * (x[k] - 0.5 * across);
  }
  return mesh::distribute(MPI_COMM_WORLD, whole);
}

void say(const std::string& text) {
  if (base::rank(MPI_COMM_WORLD) == 0) {
    fmt::print("{}\n", text);
    std::fflush(stdout);
  }
}

/// Processor time of this process [s]: on one rank other processes do not disturb it.
double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void time(const mesh::Mesh& mesh, double step, int steps, const Choice& choice) {
  for (std::size_t i = 0; i < choice.options.size(); i += 2) {
    base::check(PetscOptionsSetValue(nullptr, choice.options[i].c_str(), choice.options[i + 1].c_str()));
  }
  AcousticSettings settings;
  settings.speed_of_sound = kSpeed;
  settings.step = step;
  settings.wall_admittance = 0.005;
  settings.boundaries = {{"left", AcousticBoundaryKind::flux}, {"right", AcousticBoundaryKind::open}};
  AcousticSolver solver(mesh, settings);
  const GaussianFlux pulse({.amplitude = 1, .maximum_frequency = 5000});
  const Source source = {nullptr, nullptr, [&](double t) { return pulse.value(t); }};
  const double start = now();
  AdvanceReport report = solver.advance(step, {}, source);
  const double first = now() - start;
  report = solver.advance(std::ceil(0.3e-3 / step) * step, {}, source);  // until the pulse is inside
  double last = now(), fastest = 1e9;
  report = solver.advance(steps * step, {}, source, [&](double) {
    const double time = now();
    fastest = std::min(fastest, base::largest(mesh.comm, time - last));
    last = time;
  });
  say(fmt::format("  {:42} {:6.1f} iterations, {:7.2f} ms the fastest step, {:7.1f} ms the first{}", choice.name,
                  static_cast<double>(report.linear_iterations) / steps, 1e3 * fastest, 1e3 * first,
                  report.converged ? "" : ": " + report.reason));
  for (std::size_t i = 0; i < choice.options.size(); i += 2) {
    base::check(PetscOptionsClearValue(nullptr, choice.options[i].c_str()));
  }
}

}  // namespace
}  // namespace vocalis::acoustic

int main(int argc, char** argv) {
  using namespace vocalis::acoustic;
  const vocalis::base::Session session(argc, argv);
  PetscInt dimension = 3, levels = 3, first = 0, steps = 20, tried = static_cast<PetscInt>(choices.size());
  vocalis::base::check(PetscOptionsGetInt(nullptr, nullptr, "-dimension", &dimension, nullptr));
  vocalis::base::check(PetscOptionsGetInt(nullptr, nullptr, "-levels", &levels, nullptr));
  vocalis::base::check(PetscOptionsGetInt(nullptr, nullptr, "-first", &first, nullptr));
  vocalis::base::check(PetscOptionsGetInt(nullptr, nullptr, "-choices", &tried, nullptr));
  vocalis::base::check(PetscOptionsGetInt(nullptr, nullptr, "-steps", &steps, nullptr));
  for (int level = first; level < levels; ++level) {
    const double coarsest = 6e-3 / (1 << level);
    const vocalis::mesh::Mesh mesh = horn(dimension, level, coarsest);
    for (const double courant : {0.25, 0.7, 1.5, 3.0}) {
      say(fmt::format("{}-D, {} vertices, c dt / h {} to {} on {} ranks", dimension, mesh.vertices.num_global, courant,
                      10 * courant, vocalis::base::size(MPI_COMM_WORLD)));
      for (PetscInt i = 0; i < tried; ++i) time(mesh, courant * coarsest / kSpeed, steps, choices[i]);
    }
  }
  return 0;
}
