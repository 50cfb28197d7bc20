#include "acoustic_solver/lumped_terms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/mpi.hpp"

namespace vocalis::acoustic {

namespace {

double length_square(const double* vector, int dimension) {
  double square = 0;
  for (int k = 0; k < dimension; ++k) square += vector[k] * vector[k];
  return square;
}

/// The largest eigenvalue of Σi weight(i) n(i) n(i)ᵀ over the unit normals n(i) of a cell's facets; in space a bound of
/// it from trace and Frobenius norm, exact where the two others are equal (Wolkowicz & Styan 1980).
double cell_eigenvalue(const WaveOperator& wave, std::int32_t cell, int dimension, const double* weight) {
  double matrix[3][3] = {};
  for (int i = 0; i <= dimension; ++i) {
    const double* g = wave.gradient(cell, i);
    const double factor = weight[i] / length_square(g, dimension);
    for (int k = 0; k < dimension; ++k) {
      for (int l = 0; l < dimension; ++l) matrix[k][l] += factor * g[k] * g[l];
    }
  }
  double trace = 0, square = 0;
  for (int k = 0; k < dimension; ++k) {
    trace += matrix[k][k];
    square += length_square(matrix[k], dimension);
  }
  const double spread = std::max(square - trace * trace / dimension, 0.0);
  return trace / dimension + std::sqrt((dimension - 1.0) / dimension * spread);
}

}  // namespace

LumpedTerms lumped_terms(const mesh::Mesh& mesh, const fem::Space& space, const WaveOperator& wave) {
  constexpr int kColumns = 6;
  const int d = mesh.dimension;
  std::vector<double> sums(static_cast<std::size_t>(mesh.num_vertices()) * kColumns, 0.0);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto vertices = mesh.vertices_of(cell);
    const double measure = wave.measure(cell);
    for (int i = 0; i <= d; ++i) {
      double* sum = sums.data() + static_cast<std::size_t>(vertices[i]) * kColumns;
      sum[0] += wave.inverse_bulk_modulus() * measure / (d + 1);
      sum[1] += measure * length_square(wave.gradient(cell, i), d);
    }
  }
  for (const BoundaryFacet& facet : wave.facets()) {
    const auto vertices = mesh.vertices_of(facet.cell);
    const double share = (d + 1) * wave.facet_weight(facet);
    for (int i = 0; i <= d; ++i) {
      if (i == facet.index) continue;
      double* sum = sums.data() + static_cast<std::size_t>(vertices[i]) * kColumns;
      sum[2] += facet.on_pressure * share;
      sum[3] += facet.on_potential * share;
      sum[4] += facet.is_flux ? share : 0;
      sum[5] += facet.is_open ? facet.on_pressure * share : 0;
    }
  }
  space.halo.add_to_owners(sums, kColumns);
  space.halo.copy_to_ghosts(sums, kColumns);
  LumpedTerms terms;
  std::vector<double>* columns[kColumns] = {&terms.mass,      &terms.stiffness, &terms.admittance,
                                            &terms.potential, &terms.flux,      &terms.open_admittance};
  for (int c = 0; c < kColumns; ++c) {
    columns[c]->resize(mesh.num_vertices());
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      (*columns[c])[v] = sums[static_cast<std::size_t>(v) * kColumns + c];
    }
  }
  return terms;
}

double eigenvalue_bound(const mesh::Mesh& mesh, const WaveOperator& wave, const LumpedTerms& terms, double density) {
  double largest = 0, on_boundary = 0;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto vertices = mesh.vertices_of(cell);
    double weight[4];
    for (int i = 0; i <= mesh.dimension; ++i) weight[i] = terms.stiffness[vertices[i]] / terms.mass[vertices[i]];
    const double here = cell_eigenvalue(wave, cell, mesh.dimension, weight);
    const bool is_sound = wave.measure(cell) > 0 && std::isfinite(here);
    largest = std::max(largest, is_sound ? here : std::numeric_limits<double>::infinity());
  }
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
    on_boundary = std::max(on_boundary, terms.potential[v] / terms.mass[v]);
  }
  return (base::largest(mesh.comm, largest) + base::largest(mesh.comm, on_boundary)) / density;
}

}  // namespace vocalis::acoustic
