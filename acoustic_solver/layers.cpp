#include "acoustic_solver/layers.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"

namespace vocalis::acoustic {

namespace {

/// Mean of (x_i - mean) (x_j - mean) over a cell [m^2].
double covariance(const mesh::Mesh& mesh, std::int32_t cell, int i, int j) {
  const int n = mesh.dimension + 1;
  double mean_i = 0, mean_j = 0, product = 0;
  for (const std::int32_t v : mesh.vertices_of(cell)) {
    const double* x = mesh.point(v);
    mean_i += x[i] / n;
    mean_j += x[j] / n;
  }
  for (const std::int32_t v : mesh.vertices_of(cell)) {
    const double* x = mesh.point(v);
    product += (x[i] - mean_i) * (x[j] - mean_j);
  }
  return product / (n * (n + 1));
}

}  // namespace

Layers::Layers(const mesh::Mesh& mesh, const AcousticSettings& settings)
    : mesh_(&mesh),
      inverse_bulk_modulus_(1 / (settings.density * settings.speed_of_sound * settings.speed_of_sound)),
      density_(settings.density),
      sides_(layer_sides(mesh, settings)) {
  if (sides_.empty()) return;
  const bool is_sponge = settings.layers.front().kind == LayerKind::sponge;
  std::set<int> axes;
  for (const LayerSide& side : sides_) axes.insert(side.axis);
  needs_integral_ = !is_sponge && mesh.dimension == 3 && axes.size() > 1;
  for (std::int32_t c = 0; c < mesh.num_cells(); ++c) {
    Cell cell;
    cell.cell = c;
    mesh.dimension == 2 ? measure_cell<2>(cell) : measure_cell<3>(cell);
    double s[3] = {0, 0, 0};
    for (int k = 0; k < mesh.dimension; ++k) {
      for (int i = 0; i <= mesh.dimension; ++i) {
        s[k] += cell.gradients[i][k] * damping_up_to(sides_, k, mesh.point(mesh.vertices_of(c)[i])[k]);
      }
      s[k] = std::max(0.0, s[k]);  // a cell of bad quality may give less
    }
    const double total = s[0] + s[1] + s[2];
    if (total == 0) continue;
    cell.a = total;
    if (!is_sponge) {
      cell.b = s[0] * s[1] + s[0] * s[2] + s[1] * s[2];
      cell.g = s[0] * s[1] * s[2];
    }
    for (int i = 0; i < mesh.dimension; ++i) {
      cell.decay[i] = is_sponge ? total : s[i];
      cell.on_gradient[i] = is_sponge ? -total : total - 2 * s[i];
      cell.on_integral[i] = is_sponge ? 0 : s[(i + 1) % 3] * s[(i + 2) % 3];
      for (int j = 0; j < mesh.dimension; ++j) {
        const double moment = inverse_bulk_modulus_ * covariance(mesh, c, i, j);
        if (is_sponge || i == j) cell.moment[i][j] = moment;
        if (!is_sponge && i != j) cell.damped_moment[i][j] = s[3 - i - j] * moment;
      }
    }
    cells_.push_back(cell);
  }
}

template <int D>
void Layers::measure_cell(Cell& cell) const {
  std::array<const double*, D + 1> corners;
  for (int i = 0; i <= D; ++i) corners[i] = mesh_->point(mesh_->vertices_of(cell.cell)[i]);
  const auto geometry = fem::simplex_geometry<D>(corners);
  cell.measure = geometry.measure;
  for (int i = 0; i <= D; ++i) std::copy(geometry.gradient[i].begin(), geometry.gradient[i].end(), cell.gradients[i]);
}

void Layers::prepare(Unknowns& unknowns) const {
  const std::size_t numbers = cells_.size() * mesh_->dimension;
  if (unknowns.layer_flux.size() != numbers) unknowns.layer_flux.assign(numbers, 0.0);
  const std::size_t vertices = needs_integral_ ? mesh_->num_vertices() : 0;
  if (unknowns.layer_integral.size() != vertices) unknowns.layer_integral.assign(vertices, 0.0);
}

std::vector<double> Layers::flux_of_cells(const Unknowns& unknowns) const {
  const int d = mesh_->dimension;
  std::vector<double> of_cells(static_cast<std::size_t>(mesh_->num_cells()) * d, 0.0);
  const double* flux = unknowns.layer_flux.data();
  for (const Cell& cell : cells_) {
    std::copy_n(flux, d, of_cells.begin() + static_cast<std::ptrdiff_t>(cell.cell) * d);
    flux += d;
  }
  return of_cells;
}

void Layers::take_flux(std::span<const double> of_cells, Unknowns& unknowns) const {
  const int d = mesh_->dimension;
  unknowns.layer_flux.clear();
  for (const Cell& cell : cells_) {
    const auto flux = of_cells.begin() + static_cast<std::ptrdiff_t>(cell.cell) * d;
    unknowns.layer_flux.insert(unknowns.layer_flux.end(), flux, flux + d);
  }
}

std::vector<std::int32_t> Layers::damped_cells() const {
  std::vector<std::int32_t> marks(mesh_->num_cells(), 0);
  for (const Cell& cell : cells_) marks[cell.cell] = 1;
  return marks;
}

bool Layers::stand_still(std::span<const double> velocity) const {
  const int d = mesh_->dimension;
  const bool moves = std::any_of(cells_.begin(), cells_.end(), [&](const Cell& cell) {
    for (const std::int32_t v : mesh_->vertices_of(cell.cell)) {
      for (int k = 0; k < d; ++k) {
        if (velocity[static_cast<std::size_t>(v) * d + k] != 0) return true;
      }
    }
    return false;
  });
  return base::largest(mesh_->comm, static_cast<std::int32_t>(moves)) == 0;
}

void Layers::add_system_values(double beta, std::vector<double>& values) const {
  const int d = mesh_->dimension, n = d + 1;
  for (const Cell& cell : cells_) {
    double* entry = values.data() + static_cast<std::size_t>(cell.cell) * n * n;
    // The 1 of each factor is in the system already.
    const double mass = (cell.a + beta * (cell.b + beta * cell.g)) * inverse_bulk_modulus_ * cell.measure / (n * n);
    double matrix[3][3] = {};
    for (int k = 0; k < d; ++k) {
      const double factor = beta * (cell.on_gradient[k] + beta * cell.on_integral[k]) / (1 + beta * cell.decay[k]);
      matrix[k][k] = factor * beta / density_;
      for (int l = 0; l < d; ++l) matrix[k][l] += factor * cell.moment[k][l] / beta + cell.damped_moment[k][l];
    }
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        double product = 0;
        for (int k = 0; k < d; ++k) {
          for (int l = 0; l < d; ++l) product += cell.gradients[i][k] * matrix[k][l] * cell.gradients[j][l];
        }
        entry[i * n + j] += mass + cell.measure * product;
      }
    }
  }
}

std::array<double, 3> Layers::slope(const Cell& cell, std::span<const double> values) const {
  const auto vertices = mesh_->vertices_of(cell.cell);
  std::array<double, 3> sum = {};
  for (int i = 0; i <= mesh_->dimension; ++i) {
    for (int k = 0; k < mesh_->dimension; ++k) sum[k] += values[vertices[i]] * cell.gradients[i][k];
  }
  return sum;
}

std::array<double, 3> Layers::flux(const Cell& cell, double beta, const double* before, const Slopes& at) const {
  std::array<double, 3> result = {};
  for (int k = 0; k < mesh_->dimension; ++k) {
    double on_gradient = at.potential[k], on_integral = at.integral[k];
    for (int l = 0; l < mesh_->dimension; ++l) {
      on_gradient += cell.moment[k][l] * at.rate[l];
      on_integral += cell.moment[k][l] * at.pressure[l];
    }
    const double rate = cell.on_gradient[k] * on_gradient + cell.on_integral[k] * on_integral;
    result[k] = (before[k] + beta * rate) / (1 + beta * cell.decay[k]);
  }
  return result;
}

std::vector<double> Layers::integral_at(double beta, std::span<const double> potential,
                                        const Unknowns& beginning) const {
  std::vector<double> integral = beginning.layer_integral;
  for (std::size_t v = 0; v < integral.size(); ++v) integral[v] += beta * potential[v];
  return integral;
}

void Layers::add_forces(double beta, std::span<const double> pressure, std::span<const double> potential,
                        const Unknowns& beginning, std::span<double> sums) const {
  const int d = mesh_->dimension;
  const std::vector<double> integral = integral_at(beta, potential, beginning);
  const double* before = beginning.layer_flux.data();
  for (const Cell& cell : cells_) {
    const auto vertices = mesh_->vertices_of(cell.cell);
    double damped = 0;
    for (const std::int32_t v : vertices) {
      damped += cell.a * pressure[v] + cell.b * density_ * potential[v];
      if (cell.g != 0) damped += cell.g * density_ * integral[v];
    }
    Slopes at;
    at.pressure = slope(cell, pressure);
    at.potential = slope(cell, potential);
    if (needs_integral_) at.integral = slope(cell, integral);
    auto forward = flux(cell, beta, before, at);
    for (int k = 0; k < d; ++k) {
      for (int l = 0; l < d; ++l) forward[k] += cell.damped_moment[k][l] * at.pressure[l];
    }
    const double mass = inverse_bulk_modulus_ * cell.measure / ((d + 1) * (d + 1));
    for (int i = 0; i <= d; ++i) {
      double force = mass * damped;
      for (int k = 0; k < d; ++k) force += cell.measure * forward[k] * cell.gradients[i][k];
      sums[vertices[i]] -= force;
    }
    before += d;
  }
}

void Layers::advance(double beta, std::span<const double> pressure, std::span<const double> potential,
                     Unknowns& unknowns) const {
  const std::vector<double> integral = integral_at(beta, potential, unknowns);
  double* flux_of_cell = unknowns.layer_flux.data();
  for (const Cell& cell : cells_) {
    Slopes at;
    at.pressure = slope(cell, pressure);
    at.potential = slope(cell, potential);
    if (needs_integral_) at.integral = slope(cell, integral);
    const auto before = slope(cell, unknowns.p);
    for (int k = 0; k < mesh_->dimension; ++k) at.rate[k] = (at.pressure[k] - before[k]) / beta;
    const auto middle = flux(cell, beta, flux_of_cell, at);
    std::copy_n(middle.begin(), mesh_->dimension, flux_of_cell);
    flux_of_cell += mesh_->dimension;
  }
  unknowns.layer_integral = integral;
}

}  // namespace vocalis::acoustic
