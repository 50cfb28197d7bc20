#include "fsi_solver/mesh_motion/mesh_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"
#include "fsi_solver/mesh_motion/distortion_energy.hpp"

namespace vocalis::fsi {

namespace {

template <int D>
fem::SimplexGeometry<D> reference(const mesh::Mesh& mesh, std::int32_t cell) {
  std::array<const double*, D + 1> corners;
  for (int a = 0; a <= D; ++a) corners[a] = mesh.point(mesh.vertices_of(cell)[a]);
  return fem::simplex_geometry<D>(corners);
}

double volume(const mesh::Mesh& mesh, std::int32_t cell) {
  return mesh.dimension == 2 ? reference<2>(mesh, cell).measure : reference<3>(mesh, cell).measure;
}

template <int D>
DistortionEnergy<D> energy_of(const mesh::Mesh& mesh, std::int32_t cell, const fem::Field& displacement) {
  // Lamé's constants of MeshMotion, whose Poisson's ratio is 0.3: λ / µ = 2 ν / (1 - 2 ν), κ / µ = λ / µ + 2 / d.
  constexpr double bulk_modulus = 2 * 0.3 / (1 - 2 * 0.3) + 2.0 / D;
  typename DistortionEnergy<D>::Vertices values;
  for (int a = 0; a <= D; ++a) std::copy_n(displacement.at(mesh.vertices_of(cell)[a]), D, values[a].begin());
  return {bulk_modulus, reference<D>(mesh, cell).gradient, values};
}

/// |(G - F) F⁻¹|
template <int D>
double size_of_step(const Matrix<D>& f, const Matrix<D>& g) {
  Matrix<D> step;
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) step[i][k] = g[i][k] - f[i][k];
  }
  const Matrix<D> relative = product<D>(step, transposed<D>(cofactor<D>(f)));
  return std::sqrt(contraction<D>(relative, relative)) / determinant<D>(f);
}

}  // namespace

MeshEnergy::MeshEnergy(const Continuum& continuum, double stiffening)
    : mesh_(*continuum.mesh), weight_(mesh_.num_cells(), 0.0) {
  double total = 0;
  std::int64_t count = 0;
  for (std::int32_t cell = 0; cell < mesh_.num_cells(); ++cell) {
    if (continuum.cell_solid[cell] >= 0) continue;
    total += weight_[cell] = volume(mesh_, cell);
    ++count;
  }
  const double mean = base::sum(mesh_.comm, total) / static_cast<double>(base::sum(mesh_.comm, count));
  for (double& weight : weight_) {
    if (weight > 0) weight *= std::pow(mean / weight, stiffening);
  }
}

/// visit(cell, its energy)
template <int D, class Visit>
void MeshEnergy::visit(const fem::Field& displacement, Visit visit) const {
  for (std::int32_t cell = 0; cell < mesh_.num_cells(); ++cell) {
    if (weight_[cell] > 0) visit(cell, energy_of<D>(mesh_, cell, displacement));
  }
}

double MeshEnergy::smallest_volume(const fem::Field& displacement) const {
  double lowest = std::numeric_limits<double>::infinity();
  const auto compare = [&](std::int32_t, const auto& cell_energy) { lowest = std::min(lowest, cell_energy.j()); };
  mesh_.dimension == 2 ? visit<2>(displacement, compare) : visit<3>(displacement, compare);
  return base::smallest(mesh_.comm, lowest);
}

MeshEnergy::Change MeshEnergy::change(const fem::Field& before, const fem::Field& after) const {
  Change here;
  const auto compare = [&]<int D>(std::int32_t cell, const DistortionEnergy<D>& old) {
    const DistortionEnergy<D> now = energy_of<D>(mesh_, cell, after);
    here.energy += weight_[cell] * (now.value() - old.value());
    here.volume = std::min(here.volume, now.j() / old.j());
    here.size = std::max(here.size, size_of_step<D>(old.f(), now.f()));
  };
  mesh_.dimension == 2 ? visit<2>(before, compare) : visit<3>(before, compare);
  return {base::sum(mesh_.comm, here.energy), base::smallest(mesh_.comm, here.volume),
          base::largest(mesh_.comm, here.size)};
}

fem::Load MeshEnergy::gradient(const fem::Field& displacement) const {
  fem::Load result(*displacement.space, mesh_.dimension);
  const auto add = [&]<int D>(std::int32_t cell, const DistortionEnergy<D>& cell_energy) {
    const auto slope = cell_energy.gradient();
    for (int a = 0; a <= D; ++a) {
      double* at = result.at(mesh_.vertices_of(cell)[a]);
      for (int k = 0; k < D; ++k) at[k] += weight_[cell] * slope[a * D + k];
    }
  };
  mesh_.dimension == 2 ? visit<2>(displacement, add) : visit<3>(displacement, add);
  result.add_to_owners();
  return result;
}

std::vector<double> MeshEnergy::hessian(const fem::Field& displacement, bool curvature) const {
  const std::size_t n = static_cast<std::size_t>(mesh_.dimension + 1) * mesh_.dimension;
  std::vector<double> result(mesh_.num_cells() * n * n, 0.0);
  const auto write = [&](std::int32_t cell, const auto& cell_energy) {
    cell_energy.hessian(weight_[cell], curvature, result.data() + cell * n * n);
  };
  mesh_.dimension == 2 ? visit<2>(displacement, write) : visit<3>(displacement, write);
  return result;
}

}  // namespace vocalis::fsi
