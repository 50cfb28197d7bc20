#include <array>
#include <cmath>

#include "tests/analogies/exact_sound.hpp"

namespace vocalis::coupling::test {

namespace {

using Complex = std::complex<double>;

/// ∬ f(r, θ) dx dy over the disc of radius R, for f of period π in θ: Gauss' five points across rings that are narrow
/// about the path of the vortices, the trapezoidal rule along them.
///
/// of_radius  makes the function of θ for an r
template <class OfRadius>
Complex over_disc(const SpinningPair& pair, double R, const OfRadius& of_radius) {
  constexpr std::array<double, 5> places = {-0.906179845938664, -0.538469310105683, 0, 0.538469310105683,
                                            0.906179845938664};
  constexpr std::array<double, 5> weights = {0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366,
                                             0.236926885056189};
  const int angles = static_cast<int>(20 * pair.orbit / pair.core_radius);
  Complex sum = 0;
  for (double begin = 0; begin < R;) {
    const double away = std::abs(begin - pair.orbit);
    const double width = std::min(0.4 * pair.core_radius + 0.1 * away, R - begin);
    for (std::size_t q = 0; q < places.size(); ++q) {
      const double r = begin + 0.5 * width * (1 + places[q]);
      const auto f = of_radius(r);
      for (int i = 0; i < angles; ++i) sum += width * weights[q] * r * M_PI / angles * f(M_PI * i / angles);
    }
    begin += width;
  }
  return sum;
}

}  // namespace

double SourceWindow::weight(double r) const {
  if (r <= radius) return 1;
  return r >= end() ? 0 : 0.5 * (1 + std::cos(M_PI * (r - radius) / width));
}

double SourceWindow::slope(double r) const {
  return r <= radius || r >= end() ? 0 : -0.5 * M_PI / width * std::sin(M_PI * (r - radius) / width);
}

std::complex<double> exact_at_rest(const SpinningPair& pair, const std::string& analogy, const SourceWindow& window) {
  const MadeFlow flow = made_flow(pair);
  const double c = pair.speed_of_sound, k = 2 * pair.angular_velocity() / c;
  const bool of_forces = analogy == "lighthill" || analogy == "vortex";
  const Complex integral = over_disc(pair, window.end(), [&](double r) {
    std::array<double, 5> J;
    for (int n = 0; n < 5; ++n) J[n] = std::cyl_bessel_j(n, k * r);
    const double weight = window.weight(r), slope = window.slope(r);
    return [=, &flow, &pair](double theta) -> Complex {
      const Point x = {r * std::cos(theta), r * std::sin(theta), 0};
      const Point velocity = flow.velocity(x, 0);
      const Complex u(velocity[0], velocity[1]);
      const auto turned = [&](int n) { return J[n] * std::polar(1.0, n * theta); };
      if (of_forces) {  // w ρ u u : ∇∇, and -w ρ |u|²/2 Δ for the Lamb vector
        const Complex of_lamb = std::conj(u * u) * turned(4) + u * u * turned(0);
        const Complex of_square = analogy == "lighthill" ? 2 * std::norm(u) * turned(2) : 0;
        return 0.25 * pair.density * k * k * weight * (of_lamb - of_square);
      }
      const double p = flow.pressure(x, 0);
      const Complex rate = k * k * weight * p * turned(2);  // -w ∂tt p / c²
      if (analogy == "pressure_rate") return rate;
      const double outwards = (std::conj(u) * std::polar(1.0, theta)).real();
      const Complex along =
          0.5 * k * weight * (u * turned(1) - std::conj(u) * turned(3)) + slope * outwards * turned(2);
      return rate + Complex(0, k / c) * p * along;  // -w ∂t div(u p) / c²
    };
  });
  return integral / (2 * strength(pair));
}

}  // namespace vocalis::coupling::test
