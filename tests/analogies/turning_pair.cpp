#include "tests/analogies/turning_pair.hpp"

#include <cmath>
#include <vector>

namespace vocalis::coupling::test {

namespace {

/// The flow at a place, along r and θ.
struct Sample {
  double outwards, around, pressure, vorticity;
};

/// Over half a turn at time 0.
std::vector<Sample> samples_at(const SpinningPair& pair, double r) {
  const MadeFlow flow = made_flow(pair);
  const int angles = static_cast<int>(20 * pair.orbit / pair.core_radius);
  std::vector<Sample> samples;
  for (int i = 0; i < angles; ++i) {
    const double cosine = std::cos(M_PI * i / angles), sine = std::sin(M_PI * i / angles);
    const Point x = {r * cosine, r * sine, 0}, u = flow.velocity(x, 0);
    samples.push_back({.outwards = u[0] * cosine + u[1] * sine,
                       .around = u[1] * cosine - u[0] * sine,
                       .pressure = flow.pressure(x, 0),
                       .vorticity = vorticity(pair, x)});
  }
  return samples;
}

struct Source {
  double along, across, aside;
};

/// Minus the Lamb vector, div(w u u) - ∇(w |u|²/2).
Source lamb(const SourceWindow& window, double r, const Sample& s) {
  const double weight = window.weight(r), slope = window.slope(r), u = s.outwards, v = s.around;
  return {.along = -(weight * s.vorticity * u + slope * u * v) / r,
          .across = weight * s.vorticity * v - slope * 0.5 * (u * u - v * v),
          .aside = 0};
}

/// -w Dp/Dt / (ρ c²), by parts.
Source pressure_rate(const SpinningPair& pair, const SourceWindow& window, double r, const Sample& s) {
  const double p = s.pressure / (pair.density * pair.speed_of_sound * pair.speed_of_sound);
  return {.along = window.weight(r) * p * (s.around / r - pair.angular_velocity()),
          .across = window.weight(r) * p * s.outwards,
          .aside = window.slope(r) * p * s.outwards};
}

}  // namespace

Ring ring_at(const SpinningPair& pair, const TurningWaves& waves, double r) {
  const std::vector<Sample> samples = samples_at(pair, r);
  const int angles = static_cast<int>(samples.size());
  double swirl = 0;
  for (const Sample& s : samples) swirl += s.around / angles;
  Ring ring;
  for (int i = 0; i < angles; ++i) {
    const Sample& s = samples[i];
    const double around = waves.is_ape ? swirl : s.around, outwards = waves.is_ape ? 0 : s.outwards;
    const double a = (waves.convection ? around / r : 0) - pair.angular_velocity(), b = waves.convection ? outwards : 0;
    const Source source = waves.is_ape ? lamb(waves.window, r, s) : pressure_rate(pair, waves.window, r, s);
    for (int n = -Parts::highest; n <= Parts::highest; ++n) {
      const auto turned = std::polar(1.0 / angles, -2 * n * M_PI * i / angles);
      const auto add = [&](Parts& parts, double value) { parts.values[n + Parts::highest] += value * turned; };
      add(ring.around_around, a * a);
      add(ring.around_outwards, a * b);
      add(ring.outwards_outwards, b * b);
      add(ring.along, source.along);
      add(ring.across, source.across);
      add(ring.aside, source.aside);
    }
  }
  return ring;
}

}  // namespace vocalis::coupling::test
