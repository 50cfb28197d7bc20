#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace vocalis::fsi::test {

/// The plane channel of Causin, Gerbeau and Nobile: incompressible and inviscid fluid of small motion under an elastic
/// wall, p = 0 at both ends, symmetric at its axis.
struct Channel {
  double length = 0.05, half_height = 0.005;  ///< [m]
  double wall = 1e-3;                         ///< thickness of the wall hs [m]
  double fluid_density = 1000;                ///< [kg/m^3]
  double young_modulus = 3e5;                 ///< of the wall [Pa]
};

/// The added mass of the wall, divided by the fluid's density: pressures -ρ M a of accelerations a at its points, by
/// linear triangles for Δp = 0 with ∂p/∂n = -ρ a on the wall. Its largest eigenvalue is L / (π tanh(π R / L)).
class AddedMass {
 public:
  AddedMass(const Channel& channel, int cells_along, int cells_across)
      : points_(cells_along - 1),
        rows_(cells_across + 1),
        dx_(channel.length / cells_along),
        dy_(channel.half_height / cells_across),
        matrix_(static_cast<std::size_t>(points_) * points_) {
    for (int i = 0; i < points_; ++i) {
      std::vector<double> load(static_cast<std::size_t>(points_) * rows_, 0.0);
      load[index(i, rows_ - 1)] = dx_;
      const std::vector<double> pressure = solve(load);
      for (int j = 0; j < points_; ++j) matrix_[j * points_ + i] = pressure[index(j, rows_ - 1)];
    }
  }

  int points() const { return points_; }

  std::vector<double> operator*(const std::vector<double>& acceleration) const {
    std::vector<double> result(points_, 0.0);
    for (int i = 0; i < points_; ++i) {
      for (int j = 0; j < points_; ++j) result[i] += matrix_[i * points_ + j] * acceleration[j];
    }
    return result;
  }

  /// µ_max [m], by the power method.
  double largest_eigenvalue() const {
    std::vector<double> vector(points_, 1.0);
    double value = 0;
    for (int iteration = 0; iteration < 100; ++iteration) {
      vector = *this * vector;
      value = std::sqrt(std::inner_product(vector.begin(), vector.end(), vector.begin(), 0.0));
      for (double& entry : vector) entry /= value;
    }
    return value;
  }

 private:
  std::size_t index(int i, int row) const { return static_cast<std::size_t>(row) * points_ + i; }

  /// The stiffness matrix of right-angled triangles is the five-point formula; axis and wall have half its weight.
  std::vector<double> stiffness_times(const std::vector<double>& p) const {
    std::vector<double> result(p.size());
    for (int row = 0; row < rows_; ++row) {
      const double along = (row == 0 || row == rows_ - 1 ? 0.5 : 1) * dy_ / dx_;
      for (int i = 0; i < points_; ++i) {
        const double here = p[index(i, row)];
        double sum =
            along * (2 * here - (i > 0 ? p[index(i - 1, row)] : 0) - (i + 1 < points_ ? p[index(i + 1, row)] : 0));
        if (row > 0) sum += dx_ / dy_ * (here - p[index(i, row - 1)]);
        if (row + 1 < rows_) sum += dx_ / dy_ * (here - p[index(i, row + 1)]);
        result[index(i, row)] = sum;
      }
    }
    return result;
  }

  /// Conjugate gradients.
  std::vector<double> solve(const std::vector<double>& load) const {
    const auto dot = [](const auto& a, const auto& b) {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    };
    std::vector<double> result(load.size(), 0.0), residual = load, direction = load;
    double square = dot(residual, residual);
    const double goal = 1e-24 * square;
    while (square > goal) {
      const std::vector<double> image = stiffness_times(direction);
      const double step = square / dot(direction, image);
      for (std::size_t i = 0; i < load.size(); ++i) {
        result[i] += step * direction[i];
        residual[i] -= step * image[i];
      }
      const double ratio = dot(residual, residual) / square;
      square *= ratio;
      for (std::size_t i = 0; i < load.size(); ++i) direction[i] = residual[i] + ratio * direction[i];
    }
    return result;
  }

  int points_, rows_;
  double dx_, dy_;
  std::vector<double> matrix_;
};

/// Growth of the wall's acceleration in a loosely coupled scheme after a push.
struct Growth {
  double a_step = 0;   ///< factor a step, mean over the second half of the run
  double largest = 0;  ///< acceleration of the run over that of its first step
};

/// First solid, then fluid: leapfrog for ρs hs η'' + a η = p with the pressure of the step before, and backward Euler
/// for the fluid, p = -ρ M (η - 2 η₋ + η₋₋) / dt². Unstable at every dt where ρs hs < ρ µ_max, with ρ µ_max / (ρs hs)
/// as dt → 0. Source: Causin, Gerbeau, Nobile 2005, Comput. Methods Appl. Mech. Eng. 194, 4506.
inline Growth loosely_coupled(const Channel& channel, const AddedMass& added_mass, double solid_density, double dt,
                              int steps) {
  const int points = added_mass.points();
  const double mass = solid_density * channel.wall;
  const double spring = channel.young_modulus * channel.wall / (channel.half_height * channel.half_height);
  std::vector<double> now(points), before(points, 0.0), long_before(points, 0.0), differences(points);
  for (int i = 0; i < points; ++i) {
    const double x = static_cast<double>(i + 1) / (points + 1);
    now[i] = 4 * x * (1 - x);  // the push, by one unit of length in the first step
  }
  double first = 0, middle = 0, last = 0;
  Growth result;
  for (int step = 0; step < steps; ++step) {
    for (int i = 0; i < points; ++i) differences[i] = now[i] - 2 * before[i] + long_before[i];
    const std::vector<double> carried = added_mass * differences;
    last = 0;
    for (int i = 0; i < points; ++i) {
      const double difference = (-channel.fluid_density * carried[i] - spring * dt * dt * now[i]) / mass;
      last = std::max(last, std::abs(difference));
      long_before[i] = std::exchange(before[i], std::exchange(now[i], 2 * now[i] - before[i] + difference));
    }
    if (step == 0) first = last;
    if (step + 1 == steps / 2) middle = last;
    result.largest = std::max(result.largest, last / first);
  }
  result.a_step = std::pow(last / middle, 1.0 / (steps - steps / 2));
  return result;
}

}  // namespace vocalis::fsi::test
