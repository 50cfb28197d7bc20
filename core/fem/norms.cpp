#include "core/fem/norms.hpp"

#include <cmath>
#include <cstdint>

#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"

namespace vocalis::fem {

namespace {

/// The field at one quadrature point of one cell.
struct PointValues {
  std::span<const double> point;      ///< (dimension) [m]
  std::span<const double> values;     ///< (components)
  std::span<const double> gradients;  ///< (components, dimension)
  double weight;                      ///< includes the cell's measure
};

template <int Dimension, class Visit>
void visit_points(const Field& field, int degree, const Visit& visit) {
  const Space& space = *field.space;
  const mesh::Mesh& mesh = *space.mesh;
  const QuadratureRule& rule = quadrature(Dimension, degree);
  const std::size_t n = static_cast<std::size_t>(space.dofs_per_cell), components = field.components;
  std::vector<double> basis(n), derivatives(n * (Dimension + 1)), values(components), gradients(components * Dimension);
  std::array<double, Dimension> point{};
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto dofs = space.dofs_of(cell);
    if (dofs[0] < 0) continue;
    const auto vertices = mesh.vertices_of(cell);
    std::array<const double*, Dimension + 1> corners{};
    for (int i = 0; i <= Dimension; ++i) corners[i] = mesh.point(vertices[i]);
    const auto geometry = simplex_geometry<Dimension>(corners);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      basis_values(Dimension, space.degree, rule.points[q], basis);
      basis_derivatives(Dimension, space.degree, rule.points[q], derivatives);
      point.fill(0);
      values.assign(components, 0);
      gradients.assign(components * Dimension, 0);
      for (int i = 0; i <= Dimension; ++i) {
        for (int k = 0; k < Dimension; ++k) point[k] += rule.points[q][i] * corners[i][k];
      }
      for (std::size_t j = 0; j < n; ++j) {
        const double* u = field.at(dofs[j]);
        for (std::size_t c = 0; c < components; ++c) values[c] += basis[j] * u[c];
        for (int k = 0; k < Dimension; ++k) {
          double slope = 0;
          for (int i = 0; i <= Dimension; ++i) slope += derivatives[j * (Dimension + 1) + i] * geometry.gradient[i][k];
          for (std::size_t c = 0; c < components; ++c) gradients[c * Dimension + k] += slope * u[c];
        }
      }
      visit(PointValues{point, values, gradients, rule.weights[q] * geometry.measure});
    }
  }
}

template <class Visit>
void visit_all_points(const Field& field, int degree, const Visit& visit) {
  if (field.space->mesh->dimension == 2) {
    visit_points<2>(field, degree, visit);
  } else {
    visit_points<3>(field, degree, visit);
  }
}

/// ( Σ over ranks of ∫ |what - exact|² )^(1/2), `what` picks the values or the gradients.
double norm_of_difference(const Field& field, std::span<const double> PointValues::*what, const PointFunction& exact,
                          int degree) {
  double square = 0;
  std::vector<double> wanted;
  visit_all_points(field, degree, [&](const PointValues& at) {
    const std::span<const double> found = at.*what;
    wanted.assign(found.size(), 0);
    if (exact) exact(at.point, wanted);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double difference = found[i] - wanted[i];
      square += at.weight * difference * difference;
    }
  });
  return std::sqrt(base::sum(field.space->mesh->comm, square));
}

}  // namespace

double l2_norm(const Field& field, int degree) {
  return norm_of_difference(field, &PointValues::values, PointFunction(), degree);
}

double l2_error(const Field& field, const PointFunction& exact, int degree) {
  return norm_of_difference(field, &PointValues::values, exact, degree);
}

double h1_seminorm(const Field& field, int degree) {
  return norm_of_difference(field, &PointValues::gradients, PointFunction(), degree);
}

double h1_seminorm_error(const Field& field, const PointFunction& exact_gradient, int degree) {
  return norm_of_difference(field, &PointValues::gradients, exact_gradient, degree);
}

std::vector<double> integral(const Field& field) {
  std::vector<double> result(field.components, 0.0);
  visit_all_points(field, field.space->degree, [&](const PointValues& at) {
    for (int c = 0; c < field.components; ++c) result[c] += at.weight * at.values[c];
  });
  for (double& value : result) value = base::sum(field.space->mesh->comm, value);
  return result;
}

}  // namespace vocalis::fem
