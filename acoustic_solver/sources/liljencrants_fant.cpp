#include "acoustic_solver/sources/liljencrants_fant.hpp"

#include <cmath>
#include <numbers>

#include "acoustic_solver/sources/demand.hpp"

namespace vocalis::acoustic {

namespace {

constexpr double pi = std::numbers::pi;

/// Root of a function that changes its sign from positive to not positive between `low` and `high`.
template <typename Function>
double bisect(const Function& function, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (function(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Integral of exp(alpha (t - te)) sin(omega t) from 0 to `time`; taken relative to te it does not overflow.
double growing_sine_integral(double alpha, double omega, double excitation_time, double time) {
  const double growth = std::exp(alpha * (time - excitation_time));
  const double start = std::exp(-alpha * excitation_time);
  return (growth * (alpha * std::sin(omega * time) - omega * std::cos(omega * time)) + omega * start) /
         (alpha * alpha + omega * omega);
}

}  // namespace

LiljencrantsFantFlux::LiljencrantsFantFlux(const LiljencrantsFantPulse& settings) {
  demand(std::isfinite(settings.fundamental_frequency) && settings.fundamental_frequency > 0,
         "fundamental_frequency of the LF pulse must be positive [Hz]", settings.fundamental_frequency,
         "give the pitch, for example 100");
  demand(std::isfinite(settings.excitation) && settings.excitation > 0,
         "excitation of the LF pulse must be positive [m^3/s^2]", settings.excitation,
         "give the steepest fall of the flux, for example 0.4");
  demand(settings.open_quotient > 0 && settings.open_quotient < 1,
         "open_quotient (te over the period) must lie between 0 and 1", settings.open_quotient,
         "0.6 is usual for modal voice");
  demand(settings.asymmetry > 0.5 && settings.asymmetry < 1, "asymmetry (tp over te) must lie between 0.5 and 1",
         settings.asymmetry, "0.75 is usual for modal voice");
  period_ = 1 / settings.fundamental_frequency;
  excitation_ = settings.excitation;
  excitation_time_ = settings.open_quotient * period_;
  greatest_time_ = settings.asymmetry * excitation_time_;
  time_constant_ = settings.return_quotient * period_;
  const double closed = period_ - excitation_time_;
  demand(settings.return_quotient > 0 && time_constant_ < 0.99 * closed,
         "return_quotient (ta over the period) must be positive and below 1 - open_quotient", settings.return_quotient,
         "0.03 is usual for modal voice; a longer return phase needs a smaller open_quotient");
  // epsilon ta = 1 - exp(-epsilon closed): the trivial root 0 is left out; above it 1 - exp() - epsilon ta is positive.
  const auto return_balance = [&](double epsilon) {
    return 1 - std::exp(-epsilon * closed) - epsilon * time_constant_;
  };
  epsilon_ = bisect(return_balance, 1e-6 / time_constant_, 1 / time_constant_);
  const double return_area = return_flux(0);
  const auto area = [&](double alpha) {
    const double omega = pi / greatest_time_;
    const double start = -excitation_ / std::sin(omega * excitation_time_);
    return start * growing_sine_integral(alpha, omega, excitation_time_, excitation_time_) - return_area;
  };
  // The area of the open phase falls with alpha, from without bound to below zero.
  double low = -1 / excitation_time_;
  double high = 1 / excitation_time_;
  while (area(low) <= 0) low *= 2;
  while (area(high) > 0) high *= 2;
  alpha_ = bisect(area, low, high);
}

/// Flux that is still to fall, `after_excitation` seconds after te: minus the integral of the derivative from there on.
double LiljencrantsFantFlux::return_flux(double after_excitation) const {
  const double closed = period_ - excitation_time_;
  const double now = std::exp(-epsilon_ * after_excitation);
  const double end = std::exp(-epsilon_ * closed);
  return excitation_ / (epsilon_ * time_constant_) * ((now - end) / epsilon_ - (closed - after_excitation) * end);
}

double LiljencrantsFantFlux::open_flux(double time) const {
  const double omega = pi / greatest_time_;
  return -excitation_ / std::sin(omega * excitation_time_) *
         growing_sine_integral(alpha_, omega, excitation_time_, time);
}

double LiljencrantsFantFlux::value(double time) const {
  if (time <= 0) return 0;
  const double phase = std::fmod(time, period_);
  return phase < excitation_time_ ? open_flux(phase) : return_flux(phase - excitation_time_);
}

double LiljencrantsFantFlux::rate(double time) const {
  if (time <= 0) return 0;
  const double phase = std::fmod(time, period_);
  const double omega = pi / greatest_time_;
  if (phase < excitation_time_) {
    return -excitation_ * std::exp(alpha_ * (phase - excitation_time_)) * std::sin(omega * phase) /
           std::sin(omega * excitation_time_);
  }
  const double closed = period_ - excitation_time_;
  return -excitation_ / (epsilon_ * time_constant_) *
         (std::exp(-epsilon_ * (phase - excitation_time_)) - std::exp(-epsilon_ * closed));
}

double LiljencrantsFantFlux::peak() const { return open_flux(greatest_time_); }

}  // namespace vocalis::acoustic
