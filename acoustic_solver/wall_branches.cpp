#include "acoustic_solver/wall_branches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace vocalis::acoustic {

namespace {

// The middle of the band, 50 to 10,000 Hz, and what makes the largest error in it smallest.
constexpr double kMiddleOfBand = 707;  // [Hz]
constexpr double kRatioOfPoints = 2.18;
constexpr int kNumPoints = 6;

void check(const AcousticBoundary& boundary, const char* name, double value, bool may_be_zero) {
  if (value > 0 || (may_be_zero && value == 0)) return;
  throw base::UserError(fmt::format("{} of the wall '{}' is {}", name, boundary.group,
                                    may_be_zero ? "not negative, since a wall takes energy" : "positive"),
                        fmt::format("{}", value), fmt::format("set {} {} 0", name, may_be_zero ? ">=" : ">"));
}

}  // namespace

std::complex<double> wall_admittance(std::span<const WallBranch> branches, std::complex<double> rate) {
  std::complex<double> sum = 0;
  for (const WallBranch& branch : branches) {
    sum += 1.0 / (branch.mass * rate + branch.resistance + branch.stiffness / rate);
  }
  return sum;
}

std::vector<WallBranch> square_root_branches(double factor) {
  const double middle = std::sqrt(2 * std::numbers::pi * kMiddleOfBand);
  const double weight = factor * 2 / std::numbers::pi * std::log(kRatioOfPoints);
  std::vector<WallBranch> branches;
  double point = middle * std::pow(kRatioOfPoints, -(kNumPoints - 1) / 2.0);
  // The points left out are two geometric series: s / (s + x²) is 1 below the band, s / x² above.
  branches.push_back({0, (kRatioOfPoints - 1) / (weight * point), 0});
  for (int i = 0; i < kNumPoints; ++i) {
    branches.push_back({0, 1 / (weight * point), point / weight});
    point *= kRatioOfPoints;
  }
  branches.push_back({0, 0, (kRatioOfPoints - 1) / kRatioOfPoints * point / weight});
  return branches;
}

bool has_yielding_walls(const AcousticSettings& settings) {
  return std::any_of(settings.boundaries.begin(), settings.boundaries.end(),
                     [](const AcousticBoundary& boundary) { return yields(boundary.kind); });
}

std::vector<WallBranch> wall_branches(const AcousticSettings& settings, const AcousticBoundary& boundary) {
  if (boundary.kind == AcousticBoundaryKind::yielding) {
    check(boundary, "mass", boundary.mass, false);
    check(boundary, "resistance", boundary.resistance, true);
    check(boundary, "stiffness", boundary.stiffness, true);
    return {{boundary.mass, boundary.resistance, boundary.stiffness}};
  }
  if (boundary.kind != AcousticBoundaryKind::viscothermal) return {};
  check(boundary, "kinematic_viscosity", boundary.kinematic_viscosity, false);
  check(boundary, "thermal_diffusivity", boundary.thermal_diffusivity, true);
  check(boundary, "heat_capacity_ratio - 1", boundary.heat_capacity_ratio - 1, true);
  const double factor = std::sqrt(boundary.kinematic_viscosity) +
                        (boundary.heat_capacity_ratio - 1) * std::sqrt(boundary.thermal_diffusivity);
  return square_root_branches(factor / (settings.density * settings.speed_of_sound * settings.speed_of_sound));
}

}  // namespace vocalis::acoustic
