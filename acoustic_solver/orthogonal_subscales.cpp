#include "acoustic_solver/orthogonal_subscales.hpp"

namespace vocalis::acoustic {

namespace {

// On a line D⁻¹M is 1 - (kh)² / 6 for smooth waves: what the series leaves out is (kh)⁸ / 1300 of the square of the
// frequency, and the inverse itself errs by (kh)⁴ / 90.
constexpr int kCorrections = 3;

void share(std::vector<double>& sums, int columns, const base::Halo& halo) {
  halo.add_to_owners(sums, columns);
  halo.copy_to_ghosts(sums, columns);
}

}  // namespace

std::vector<double> OrthogonalSubscales::project(std::span<const double> slopes,
                                                 std::span<const double> weights) const {
  const int d = mesh_->dimension;
  const int n = d + 1;
  // (slope, basis function), then the lumped mass of each vertex.
  std::vector<double> load(static_cast<std::size_t>(mesh_->num_vertices()) * n, 0.0);
  for (std::int32_t cell = 0; cell < mesh_->num_cells(); ++cell) {
    const double* slope = slopes.data() + static_cast<std::size_t>(cell) * d;
    for (const std::int32_t vertex : mesh_->vertices_of(cell)) {
      double* sum = load.data() + static_cast<std::size_t>(vertex) * n;
      for (int k = 0; k < d; ++k) sum[k] += weights[cell] / n * slope[k];
      sum[d] += weights[cell] / n;
    }
  }
  share(load, n, space_->halo);
  std::vector<double> projected(static_cast<std::size_t>(mesh_->num_vertices()) * d, 0.0);
  std::vector<double> product(projected.size(), 0.0);
  for (int correction = 0;; ++correction) {
    for (std::size_t i = 0; i < projected.size(); ++i) {
      const double* sum = load.data() + i / d * n;
      projected[i] += (sum[i % d] - product[i]) / sum[d];
    }
    if (correction == kCorrections) return projected;
    product.assign(projected.size(), 0.0);
    for (std::int32_t cell = 0; cell < mesh_->num_cells(); ++cell) {
      const auto vertices = mesh_->vertices_of(cell);
      const double weight = weights[cell] / (n * (n + 1));
      double total[3] = {0, 0, 0};
      for (const std::int32_t vertex : vertices) {
        for (int k = 0; k < d; ++k) total[k] += projected[static_cast<std::size_t>(vertex) * d + k];
      }
      for (const std::int32_t vertex : vertices) {
        const std::size_t first = static_cast<std::size_t>(vertex) * d;
        for (int k = 0; k < d; ++k) product[first + k] += weight * (total[k] + projected[first + k]);
      }
    }
    share(product, d, space_->halo);
  }
}

void OrthogonalSubscales::add(std::span<const double> gradients, std::span<const double> weights,
                              std::span<const double> values, std::span<double> sums) const {
  const int d = mesh_->dimension;
  const int n = d + 1;
  std::vector<double> slopes(static_cast<std::size_t>(mesh_->num_cells()) * d, 0.0);
  for (std::int32_t cell = 0; cell < mesh_->num_cells(); ++cell) {
    const auto vertices = mesh_->vertices_of(cell);
    const double* gradient = gradients.data() + static_cast<std::size_t>(cell) * n * d;
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < d; ++k)
        slopes[static_cast<std::size_t>(cell) * d + k] += values[vertices[i]] * gradient[i * d + k];
    }
  }
  const std::vector<double> projected = project(slopes, weights);
  for (std::int32_t cell = 0; cell < mesh_->num_cells(); ++cell) {
    const auto vertices = mesh_->vertices_of(cell);
    const double* gradient = gradients.data() + static_cast<std::size_t>(cell) * n * d;
    double unseen[3] = {0, 0, 0};  // mean of P⊥∇x
    for (int k = 0; k < d; ++k) {
      unseen[k] = slopes[static_cast<std::size_t>(cell) * d + k];
      for (const std::int32_t vertex : vertices) unseen[k] -= projected[static_cast<std::size_t>(vertex) * d + k] / n;
    }
    for (int i = 0; i < n; ++i) {
      double product = 0;
      for (int k = 0; k < d; ++k) product += unseen[k] * gradient[i * d + k];
      sums[vertices[i]] += weights[cell] * product;
    }
  }
}

}  // namespace vocalis::acoustic
