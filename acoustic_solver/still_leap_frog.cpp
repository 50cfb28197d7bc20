#include "acoustic_solver/still_leap_frog.hpp"

#include <algorithm>
#include <cmath>

#include "acoustic_solver/leap_frog.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::acoustic {

namespace {

constexpr int kLanczosSteps = 60;

/// The largest eigenvalue of a symmetric tridiagonal matrix, by bisection with Sturm's sequence.
double largest_of_tridiagonal(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  double low = 0, high = 0;
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    const double radius = (i > 0 ? beside[i - 1] : 0) + (i + 1 < diagonal.size() ? beside[i] : 0);
    high = std::max(high, diagonal[i] + radius);
  }
  while (high - low > 1e-6 * high) {
    const double middle = 0.5 * (low + high);
    double pivot = 1;
    bool above = false;
    for (std::size_t i = 0; i < diagonal.size() && !above; ++i) {
      pivot = diagonal[i] - middle - (i > 0 ? beside[i - 1] * beside[i - 1] / pivot : 0);
      above = pivot >= 0;
    }
    (above ? low : high) = middle;
  }
  return high;
}

/// Between -1 and 1, the same for a vertex whatever the ranks.
double scattered(std::int64_t number) {
  const auto mixed = static_cast<std::uint64_t>(number + 1) * 0x9e3779b97f4a7c15U;
  return static_cast<double>(mixed >> 11) * 0x1p-52 - 1;
}

}  // namespace

StillLeapFrog::StillLeapFrog(const mesh::Mesh& mesh, const fem::Space& space, const WaveOperator& wave, double density)
    : mesh_(&mesh),
      space_(&space),
      density_(density),
      rows_(assemble_still_rows(mesh, wave)),
      terms_(lumped_terms(mesh, space, wave)),
      released_(rows_.num_rows(), 0) {
  std::vector<char> is_released(mesh.num_vertices(), 0);
  for (const std::int32_t v : wave.released()) is_released[v] = 1;
  for (std::int32_t row = 0; row < rows_.num_rows(); ++row) {
    const std::int32_t v = rows_.vertex[row];
    released_[row] = is_released[v];
    const BoundaryRow here = {row, terms_.admittance[v], terms_.potential[v], terms_.flux[v]};
    if (here.admittance != 0 || here.potential != 0 || here.flux != 0) boundary_.push_back(here);
  }
  const std::size_t num_columns = rows_.map.num_local();
  pressure_.resize(rows_.num_rows());
  inverse_diagonal_.resize(rows_.num_rows());
  potential_.resize(num_columns);
  increment_.resize(num_columns);
  largest_eigenvalue_ = std::min(lanczos(), eigenvalue_bound(mesh, wave, terms_, density));
}

double StillLeapFrog::lanczos() const {
  const std::int32_t n = rows_.num_rows();
  std::vector<double> scale(rows_.map.num_local()), vector(rows_.map.num_local()), product(n), before(n, 0.0);
  const auto dot = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::int32_t i = 0; i < n; ++i) sum += a[i] * b[i];
    return base::sum(mesh_->comm, sum);
  };
  for (std::int32_t row = 0; row < n; ++row) {
    const std::int32_t v = rows_.vertex[row];
    scale[row] = released_[row] ? 0 : 1 / std::sqrt(density_ * terms_.mass[v]);
    vector[row] = scattered(mesh_->vertex_input[v]);
  }
  rows_.halo.copy_to_ghosts(scale);
  const double length = std::sqrt(dot(vector, vector));
  for (double& value : vector) value /= length;
  std::vector<double> diagonal, beside;
  for (int step = 0; step < kLanczosSteps; ++step) {
    rows_.halo.copy_to_ghosts(vector);
    for (std::int32_t i = 0; i < n; ++i) {
      const double x = scale[i] * vector[i];
      double sum = terms_.potential[rows_.vertex[i]] * x;
      for (std::int32_t k = rows_.starts[i]; k < rows_.starts[i + 1]; ++k) {
        const std::int32_t j = rows_.columns[k];
        sum += rows_.stiffness[k] * (scale[j] * vector[j] - x);
      }
      product[i] = scale[i] * sum - (beside.empty() ? 0 : beside.back() * before[i]);
    }
    diagonal.push_back(dot(vector, product));
    for (std::int32_t i = 0; i < n; ++i) product[i] -= diagonal.back() * vector[i];
    const double next = std::sqrt(dot(product, product));
    if (!(next > 1e-12 * diagonal.front())) break;
    beside.push_back(next);
    for (std::int32_t i = 0; i < n; ++i) {
      before[i] = vector[i];
      vector[i] = product[i] / next;
    }
  }
  return largest_of_tridiagonal(diagonal, beside);
}

void StillLeapFrog::set_step(double dt) {
  if (dt == dt_) return;
  dt_ = dt;
  const double from_mass = consistent_part(mesh_->dimension) / dt, from_time = dt / (12 * density_);
  correction_.resize(rows_.columns.size());
  for (std::size_t k = 0; k < correction_.size(); ++k) {
    correction_[k] = from_mass * rows_.mass[k] + from_time * rows_.stiffness[k];
  }
  for (std::int32_t row = 0; row < rows_.num_rows(); ++row) {
    const std::int32_t v = rows_.vertex[row];
    inverse_diagonal_[row] = released_[row] ? 0 : 1 / (terms_.mass[v] / dt + terms_.admittance[v] / 2);
  }
}

void StillLeapFrog::sweep_stiffness(std::int32_t first, std::int32_t last) {
  const double* potential = potential_.data();
  const double* stiffness = rows_.stiffness.data();
  const std::int32_t* columns = rows_.columns.data();
  for (std::int32_t i = first; i < last; ++i) {
    const double here = potential[i];
    double sum = 0;
    for (std::int32_t k = rows_.starts[i]; k < rows_.starts[i + 1]; ++k) {
      sum += stiffness[k] * (potential[columns[k]] - here);
    }
    increment_[i] = -inverse_diagonal_[i] * sum;
  }
}

void StillLeapFrog::sweep_correction(std::int32_t first, std::int32_t last, double potential_factor) {
  const double* increment = increment_.data();
  const double* correction = correction_.data();
  const std::int32_t* columns = rows_.columns.data();
  for (std::int32_t i = first; i < last; ++i) {
    const double here = increment[i];
    double sum = 0;
    for (std::int32_t k = rows_.starts[i]; k < rows_.starts[i + 1]; ++k) {
      sum += correction[k] * (here - increment[columns[k]]);
    }
    pressure_[i] += here + inverse_diagonal_[i] * sum;
    potential_[i] += potential_factor * pressure_[i];
  }
}

void StillLeapFrog::sub_step(double flux, double potential_factor) {
  rows_.halo.begin_copy_to_ghosts(potential_);
  sweep_stiffness(0, rows_.num_inner);
  rows_.halo.end_copy_to_ghosts(potential_);
  sweep_stiffness(rows_.num_inner, rows_.num_rows());
  for (const BoundaryRow& at : boundary_) {
    const double force = at.flux * flux - at.admittance * pressure_[at.row] - at.potential * potential_[at.row];
    increment_[at.row] += inverse_diagonal_[at.row] * force;
  }
  for (std::size_t row = 0; row < load_.size(); ++row) increment_[row] += inverse_diagonal_[row] * load_[row];
  rows_.halo.begin_copy_to_ghosts(increment_);
  sweep_correction(0, rows_.num_inner, potential_factor);
  rows_.halo.end_copy_to_ghosts(increment_);
  sweep_correction(rows_.num_inner, rows_.num_rows(), potential_factor);
}

bool StillLeapFrog::advance(const SubStep& step, int parts, State& state) {
  const double dt = step.dt / parts;
  set_step(dt);
  const std::int32_t n = rows_.num_rows();
  for (std::int32_t row = 0; row < n; ++row) {
    pressure_[row] = state.p[rows_.vertex[row]];
    potential_[row] = state.psi[rows_.vertex[row]] + 0.5 * dt / density_ * pressure_[row];
  }
  load_.resize(step.load.empty() ? 0 : n);
  for (int part = 0; part < parts; ++part) {
    const double from_middle = (part + 0.5) / parts - 0.5;
    for (std::size_t row = 0; row < load_.size(); ++row) {
      const std::int32_t v = rows_.vertex[row];
      load_[row] = step.load[v] + from_middle * step.load_change[v];
    }
    double flux = 0;
    if (step.flux_at) {
      const double begin = step.begin + part * dt;
      flux = 0.5 * (step.flux_at(begin) + step.flux_at(begin + dt));
    }
    sub_step(flux, (part + 1 < parts ? 1 : 0.5) * dt / density_);
  }
  double sum = 0;
  for (const double p : pressure_) sum += std::abs(p);
  if (!std::isfinite(base::sum(mesh_->comm, sum))) return false;
  for (std::int32_t row = 0; row < n; ++row) {
    state.p[rows_.vertex[row]] = pressure_[row];
    state.psi[rows_.vertex[row]] = potential_[row];
  }
  space_->halo.copy_to_ghosts(state.p);
  space_->halo.copy_to_ghosts(state.psi);
  return true;
}

double StillLeapFrog::bytes_of_a_sub_step() const {
  const double entries = static_cast<double>(rows_.columns.size()), rows = rows_.num_rows();
  // First sweep: ψ, diagonal, starts in, increment out. Second: increment, diagonal, starts, p, ψ in, p, ψ out.
  return 2 * 12 * entries + (8 + 8 + 4 + 8) * rows + (8 + 8 + 4 + 16 + 16) * rows;
}

}  // namespace vocalis::acoustic
