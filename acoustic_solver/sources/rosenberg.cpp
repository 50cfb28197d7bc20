#include "acoustic_solver/sources/rosenberg.hpp"

#include <cmath>
#include <numbers>

#include "acoustic_solver/sources/demand.hpp"

namespace vocalis::acoustic {

namespace {
constexpr double pi = std::numbers::pi;
}  // namespace

RosenbergFlux::RosenbergFlux(const RosenbergPulse& settings)
    : period_(1 / settings.fundamental_frequency), amplitude_(settings.amplitude) {
  demand(std::isfinite(settings.fundamental_frequency) && settings.fundamental_frequency > 0,
         "fundamental_frequency of Rosenberg's pulse must be positive [Hz]", settings.fundamental_frequency,
         "give the pitch, for example 100");
  demand(std::isfinite(settings.amplitude) && settings.amplitude != 0,
         "the amplitude of Rosenberg's pulse must not be zero", settings.amplitude,
         "give the peak flux in m^3/s (or the velocity in m/s), for example 4e-4");
  demand(settings.open_quotient > 0 && settings.open_quotient <= 1,
         "open_quotient (time open over the period) must lie between 0 and 1", settings.open_quotient,
         "0.56 is usual for modal voice");
  demand(std::isfinite(settings.speed_quotient) && settings.speed_quotient > 0,
         "speed_quotient (time of opening over time of closing) must be positive", settings.speed_quotient,
         "2.5 is usual for modal voice");
  const double open = settings.open_quotient * period_;
  closing_ = open / (1 + settings.speed_quotient);
  opening_ = open - closing_;
}

double RosenbergFlux::value(double time) const {
  if (time <= 0) return 0;
  const double phase = std::fmod(time, period_);
  if (phase < opening_) return 0.5 * amplitude_ * (1 - std::cos(pi * phase / opening_));
  if (phase < opening_ + closing_) return amplitude_ * std::cos(0.5 * pi * (phase - opening_) / closing_);
  return 0;
}

double RosenbergFlux::rate(double time) const {
  if (time <= 0) return 0;
  const double phase = std::fmod(time, period_);
  if (phase < opening_) return 0.5 * amplitude_ * pi / opening_ * std::sin(pi * phase / opening_);
  if (phase < opening_ + closing_) {
    return -0.5 * amplitude_ * pi / closing_ * std::sin(0.5 * pi * (phase - opening_) / closing_);
  }
  return 0;
}

}  // namespace vocalis::acoustic
