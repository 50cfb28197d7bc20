#include "fsi_solver/mesh_motion/mesh_motion.hpp"

#include <cmath>

#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"
#include "fsi_solver/mesh_motion/mesh_matrix.hpp"
#include "fsi_solver/solution/direct_solver.hpp"

namespace vocalis::fsi {

namespace {

/// ∫ λ div u div w + 2 µ ε(u) : ε(w) of each fluid cell, λ = µ 2 ν / (1 - 2 ν), (cells, n, n).
template <int D>
std::vector<double> cell_matrices(const Continuum& continuum, double stiffening) {
  const mesh::Mesh& mesh = *continuum.mesh;
  constexpr int n = D * (D + 1);
  std::vector<double> values(static_cast<std::size_t>(mesh.num_cells()) * n * n, 0.0);
  double volume = 0;
  std::int64_t count = 0;
  const auto geometry_of = [&](std::int32_t cell) {
    std::array<const double*, D + 1> corners;
    for (int a = 0; a <= D; ++a) corners[a] = mesh.point(mesh.vertices_of(cell)[a]);
    return fem::simplex_geometry<D>(corners);
  };
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (continuum.cell_solid[cell] >= 0) continue;
    volume += geometry_of(cell).measure;
    ++count;
  }
  const double mean = base::sum(mesh.comm, volume) / static_cast<double>(base::sum(mesh.comm, count));
  constexpr double lame_ratio = 2 * 0.3 / (1 - 2 * 0.3);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (continuum.cell_solid[cell] >= 0) continue;
    const auto [g, measure] = geometry_of(cell);
    const double weight = measure * std::pow(mean / measure, stiffening);
    double* matrix = values.data() + static_cast<std::size_t>(cell) * n * n;
    for (int a = 0; a <= D; ++a) {
      for (int b = 0; b <= D; ++b) {
        double both = 0;
        for (int k = 0; k < D; ++k) both += g[a][k] * g[b][k];
        for (int i = 0; i < D; ++i) {
          for (int j = 0; j < D; ++j) {
            matrix[(a * D + i) * n + b * D + j] =
                weight * (lame_ratio * g[a][i] * g[b][j] + g[b][i] * g[a][j] + (i == j ? both : 0.0));
          }
        }
      }
    }
  }
  return values;
}

}  // namespace

MeshMotion::MeshMotion(const Continuum& continuum, const Conditions& conditions, double stiffening)
    : continuum_(continuum),
      layout_(continuum.mesh->comm, {{&continuum.mesh->vertices, continuum.mesh->dimension}}),
      constrained_(constrained_places(continuum, conditions)) {
  const mesh::Mesh& mesh = *continuum.mesh;
  const int d = mesh.dimension;
  matrix_ = make_mesh_matrix(continuum, layout_, constrained_);
  matrix_->assemble(d == 2 ? cell_matrices<2>(continuum, stiffening) : cell_matrices<3>(continuum, stiffening));
  solver_ = create_repeatable_solver(matrix_->get(), "mesh_motion_", Reuse::many_solves);
  base::check(KSPSetOperators(solver_.get(), matrix_->get(), matrix_->get()));
  right_hand_side_ = la::create_vector(mesh.comm, layout_.num_owned());
  solution_ = la::create_vector(mesh.comm, layout_.num_owned());
}

la::SolveReport MeshMotion::extend(fem::Field& displacement) {
  const int d = continuum_.mesh->dimension;
  {
    const la::OwnedValues values(right_hand_side_.get());
    for (std::size_t i = 0; i < constrained_.size(); ++i) {
      const bool in_solid = continuum_.vertex_solid[i / d] >= 0;
      values[static_cast<PetscInt>(i)] = in_solid ? displacement.values[i] : 0.0;
    }
  }
  const la::SolveReport report = la::solve(solver_.get(), right_hand_side_.get(), solution_.get());
  {
    const la::ReadValues values(solution_.get());
    for (std::size_t i = 0; i < constrained_.size(); ++i) {
      if (continuum_.vertex_solid[i / d] < 0) displacement.values[i] = values[static_cast<PetscInt>(i)];
    }
  }
  displacement.copy_to_ghosts();
  return report;
}

}  // namespace vocalis::fsi
