#include <array>
#include <cmath>
#include <vector>

#include "tests/analogies/turning_pair.hpp"

namespace vocalis::coupling::test {

namespace {

using Complex = std::complex<double>;

constexpr int highest = Parts::highest / 2;  ///< orders -2 highest to 2 highest of θ
constexpr int orders = 2 * highest + 1;      ///< unknowns a node
constexpr int reach = 2 * orders - 1;        ///< of the band beside the diagonal

/// Rows of a matrix with `reach` entries on both sides of the diagonal, and the right-hand side.
struct Band {
  explicit Band(std::size_t rows) : entries(rows), load(rows) {}
  Complex& at(std::size_t row, std::size_t column) { return entries[row][column + reach - row]; }
  /// By elimination without exchange of rows.
  std::vector<Complex> solve() {
    const std::size_t rows = load.size();
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t below = i + 1; below < std::min(rows, i + reach + 1); ++below) {
        const Complex factor = at(below, i) / at(i, i);
        for (std::size_t j = i; j < std::min(rows, i + reach + 1); ++j) at(below, j) -= factor * at(i, j);
        load[below] -= factor * load[i];
      }
    }
    for (std::size_t i = rows; i-- > 0;) {
      for (std::size_t j = i + 1; j < std::min(rows, i + reach + 1); ++j) load[i] -= at(i, j) * load[j];
      load[i] /= at(i, i);
    }
    return load;
  }
  std::vector<std::array<Complex, 2 * reach + 1>> entries;
  std::vector<Complex> load;
};

/// Adds ∇ψ·∇q* - Dψ Dq* / c² and the source at one point of an element whose first node has the number `node`.
void add_point(Band& band, int node, const Ring& ring, double r, double weight, double c, const double (&value)[2],
               const double (&slope)[2]) {
  for (int i = 0; i < 2; ++i) {
    for (int row = -highest; row <= highest; ++row) {
      const std::size_t at = static_cast<std::size_t>(node + i) * orders + row + highest;
      const Complex m(0, 2 * row);
      band.load[at] +=
          weight * (-m * value[i] * ring.along(row) + slope[i] * ring.across(row) + value[i] * ring.aside(row));
      for (int j = 0; j < 2; ++j) {
        for (int column = -highest; column <= highest; ++column) {
          const Complex n(0, 2 * column);
          const int d = row - column;
          Complex sum = -(-m * n * value[i] * value[j] * ring.around_around(d) +
                          (n * slope[i] * value[j] - m * value[i] * slope[j]) * ring.around_outwards(d) +
                          slope[i] * slope[j] * ring.outwards_outwards(d)) /
                        (c * c);
          if (d == 0) sum += slope[i] * slope[j] - m * n / (r * r) * value[i] * value[j];
          band.at(at, static_cast<std::size_t>(node + j) * orders + column + highest) += weight * sum;
        }
      }
    }
  }
}

/// H_m' / H_m of a wave e^{im(θ - ωt)} that leaves, times kR; anything for m = 0, whose ψ is not heard.
Complex leaving(int m, double kR) {
  if (m == 0) return -1;
  const auto hankel = [&](int n) {
    return Complex(std::cyl_bessel_j(n, kR), (m > 0 ? 1 : -1) * std::cyl_neumann(n, kR));
  };
  return kR * 0.5 * (hankel(std::abs(m) - 1) - hankel(std::abs(m) + 1)) / hankel(std::abs(m));
}

/// r of the nodes from 0 to R.
std::vector<double> nodes_to(double R, const SpinningPair& pair, double elements) {
  std::vector<double> r = {0};
  while (r.back() < R) {
    const double away = std::max(0.0, std::abs(r.back() - pair.orbit) - 2 * pair.core_radius);
    r.push_back(r.back() + std::min(0.25 * pair.core_radius + 0.06 * away, pair.wavelength() / 60) / elements);
  }
  const double scale = R / r.back();
  for (double& one : r) one *= scale;
  return r;
}

}  // namespace

std::complex<double> exact_in_flow(const SpinningPair& pair, const std::string& analogy, const SourceWindow& window,
                                   bool convection, double elements) {
  const TurningWaves waves = {analogy == "ape", convection, window};
  const double R = pair.flow_radius(), c = pair.speed_of_sound;
  const std::vector<double> r = nodes_to(R, pair, elements);
  const int last = static_cast<int>(r.size()) - 1;
  Band band(r.size() * orders);
  for (int e = 0; e < last; ++e) {
    const double h = r[e + 1] - r[e];
    for (const double s : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)}) {
      const double here = r[e] + s * h;
      const Ring ring = ring_at(pair, waves, here);
      add_point(band, e, ring, here, 0.5 * h * here, c, {1 - s, s}, {-1 / h, 1 / h});
    }
  }
  for (int n = -highest; n <= highest; ++n) {
    const std::size_t rim = static_cast<std::size_t>(last) * orders + n + highest, middle = n + highest;
    band.at(rim, rim) -= leaving(2 * n, std::abs(2 * n) * pair.angular_velocity() / c * R);
    if (n == 0) continue;
    for (std::size_t j = 0; j < 2 * orders; ++j) band.at(middle, j) = 0;  // ψ_m = 0 at r = 0
    band.at(middle, middle) = 1;
    band.load[middle] = 0;
  }
  const Complex psi = 2.0 * band.solve()[static_cast<std::size_t>(last) * orders + highest - 1];  // of e^{-2iθ}
  const Complex pressure = pair.density * (waves.is_ape ? Complex(1) : Complex(0, 2 * pair.angular_velocity())) * psi;
  return pressure / far_field(pair, R, 0);
}

}  // namespace vocalis::coupling::test
