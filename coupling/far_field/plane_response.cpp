#include "coupling/far_field/plane_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vocalis::coupling {

namespace {

constexpr double interpolation_error = 1e-6;
constexpr int most_nodes = 32;

/// At T = τ + since: sqrt(T² - τ²) without cancellation, and arcosh(T / τ).
struct Behind {
  double root, logarithm;
};
Behind behind(double since, double delay) {
  const double root = std::sqrt(since * (since + 2 * delay));
  return {root, std::log1p((since + root) / delay)};
}

}  // namespace

double line_mass_response(double since, double delay) {
  if (since <= 0) return 0;
  const auto [root, logarithm] = behind(since, delay);
  return ((since + delay) * logarithm - root) / (2 * std::numbers::pi);
}

double line_force_response(double since, double delay, double speed_of_sound) {
  if (since <= 0) return 0;
  const auto [root, logarithm] = behind(since, delay);
  const double integral = 0.5 * ((since + delay) * root - delay * delay * logarithm);
  return integral / (2 * std::numbers::pi * speed_of_sound * delay);
}

std::vector<double> response_delays(double least, double largest) {
  const double middle = 0.5 * (least + largest), half = 0.5 * (largest - least);
  if (half <= 1e-9 * middle) return {middle};
  // The responses are analytic in the Bernstein ellipse of the delays that ends at 0: the error is its axes' sum^-n.
  const double axes = middle / half + std::sqrt(middle * middle / (half * half) - 1);
  const int count =
      std::clamp(static_cast<int>(std::ceil(-std::log(interpolation_error) / std::log(axes))), 1, most_nodes);
  std::vector<double> nodes;
  for (int k = 0; k < count; ++k) nodes.push_back(middle - half * std::cos(std::numbers::pi * (k + 0.5) / count));
  return nodes;
}

std::vector<double> interpolation_weights(const std::vector<double>& nodes, double delay) {
  std::vector<double> weights(nodes.size(), 1.0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      if (j != i) weights[i] *= (delay - nodes[j]) / (nodes[i] - nodes[j]);
    }
  }
  return weights;
}

}  // namespace vocalis::coupling
