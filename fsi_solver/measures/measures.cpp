#include <cmath>

#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "core/mesh/geometry.hpp"
#include "fsi_solver/continuum.hpp"
#include "fsi_solver/fsi_solver.hpp"

namespace vocalis::fsi {

namespace {

/// Outward normal times measure of a facet whose corners, and the cell's corner opposite, are given.
std::array<double, 3> area_vector(int d, const double* const* corners, const double* opposite) {
  double e[3][3] = {};
  for (int k = 0; k < d; ++k) {
    for (int i = 1; i < d; ++i) e[i - 1][k] = corners[i][k] - corners[0][k];
    e[2][k] = opposite[k] - corners[0][k];
  }
  std::array<double, 3> n = {e[0][1], -e[0][0], 0};
  if (d == 3) {
    n = {0.5 * (e[0][1] * e[1][2] - e[0][2] * e[1][1]), 0.5 * (e[0][2] * e[1][0] - e[0][0] * e[1][2]),
         0.5 * (e[0][0] * e[1][1] - e[0][1] * e[1][0])};
  }
  const double inward = n[0] * e[2][0] + n[1] * e[2][1] + n[2] * e[2][2];
  for (double& component : n) component *= inward > 0 ? -1 : 1;
  return n;
}

/// Whether a normal points towards larger x, or y if it has no x, ...
bool points_ahead(const std::array<double, 3>& n) {
  const double size = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
  for (const double component : n) {
    if (std::abs(component) > 1e-9 * size) return component > 0;
  }
  return true;
}

}  // namespace

double flux(const FsiSolver& solver, const std::string& group) {
  const mesh::Mesh& mesh = *solver.continuum().mesh;
  const int d = mesh.dimension;
  const std::vector<double> x = solver.current_coordinates();
  const fem::Field velocity = solver.velocity_at_vertices();
  const auto at = [&](std::int32_t vertex) { return x.data() + static_cast<std::size_t>(vertex) * d; };
  double sum = 0;
  for (const mesh::NamedFacet& facet : mesh::facets_of_group(mesh, group)) {
    const auto corners = mesh::facet_vertices(mesh, facet.cell, facet.index);
    const double* points[3] = {at(corners[0]), at(corners[1]), d == 3 ? at(corners[2]) : nullptr};
    const auto n = area_vector(d, points, at(mesh.vertices_of(facet.cell)[facet.index]));
    const bool exterior = mesh.cell_neighbours[static_cast<std::size_t>(facet.cell) * (d + 1) + facet.index] < 0;
    // A facet inside the mesh is listed from both of its sides; only one of them counts.
    if (!exterior) {
      const auto reference = mesh::facet_geometry(mesh, facet.cell, facet.index);
      if (!points_ahead(reference.normal)) continue;
    }
    for (int i = 0; i < d; ++i) {
      const double* v = velocity.at(corners[i]);
      for (int k = 0; k < d; ++k) sum += v[k] * n[k] / d;
    }
  }
  return base::sum(mesh.comm, sum);
}

double smallest_quality(const FsiSolver& solver) {
  return smallest_fluid_quality(solver.continuum(), solver.current_coordinates());
}

}  // namespace vocalis::fsi
