#include "acoustic_solver/sources/gaussian_pulse.hpp"

#include <cmath>
#include <numbers>

#include "acoustic_solver/sources/demand.hpp"

namespace vocalis::acoustic {

namespace {
constexpr double pi = std::numbers::pi;
}  // namespace

GaussianFlux::GaussianFlux(const GaussianPulse& settings) : amplitude_(settings.amplitude), width_(0) {
  demand(std::isfinite(settings.amplitude) && settings.amplitude != 0, "the amplitude of the pulse must not be zero",
         settings.amplitude, "give the peak flux in m^3/s (or the velocity in m/s), for example 1e-4");
  demand(std::isfinite(settings.maximum_frequency) && settings.maximum_frequency > 0,
         "maximum_frequency of the Gaussian pulse must be positive [Hz]", settings.maximum_frequency,
         "give the highest frequency of interest, for example 10000");
  width_ = std::sqrt(2 * std::numbers::ln10) / (2 * pi * settings.maximum_frequency);
}

double GaussianFlux::value(double time) const {
  const double x = (time - delay()) / width_;
  return amplitude_ * std::exp(-0.5 * x * x);
}

double GaussianFlux::rate(double time) const { return -(time - delay()) / (width_ * width_) * value(time); }

std::complex<double> GaussianFlux::spectrum(double frequency) const {
  const double x = 2 * pi * frequency * width_;
  return amplitude_ * width_ * std::sqrt(2 * pi) * std::exp(-0.5 * x * x) *
         std::polar(1.0, -2 * pi * frequency * delay());
}

}  // namespace vocalis::acoustic
