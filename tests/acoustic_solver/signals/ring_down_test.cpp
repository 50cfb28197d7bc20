#include "acoustic_solver/signals/ring_down.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "acoustic_solver/pulse.hpp"

using namespace vocalis::acoustic;

namespace {

constexpr double pi = std::numbers::pi;

struct Line {
  double frequency;
  double bandwidth;
  double amplitude;
};

std::vector<double> ringing(const std::vector<Line>& lines, double rate, double duration, double noise, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::vector<double> series;
  for (int n = 0; n < static_cast<int>(duration * rate); ++n) {
    const double time = n / rate;
    double value = noise * normal(generator);
    for (const Line& line : lines) {
      value += line.amplitude * std::exp(-pi * line.bandwidth * time) *
               std::cos(2 * pi * line.frequency * time + 0.001 * line.frequency);
    }
    series.push_back(value);
  }
  return series;
}

/// Modes of the rigid vowel /i/; the strongest and the weakest are 40 dB apart.
std::vector<Line> rigid_i(std::size_t weakest) {
  std::vector<Line> lines{{226, 1, 1}, {2497, 4, 0.3}, {3193, 250, 0.3}, {3916, 40, 0.3}};
  lines[weakest].amplitude = 0.01;
  return lines;
}

}  // namespace

TEST_CASE("30 ms of the rigid vowel /i/ in noise of -80 dB give its resonances", "[serial]") {
  for (std::size_t weakest = 0; weakest < 4; ++weakest) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      for (double rate : {44100.0, 100000.0}) {
        std::vector<Line> lines = rigid_i(weakest);
        const auto modes = damped_modes(ringing(lines, rate, 0.03, 1e-4, seed), rate, {});
        CAPTURE(weakest, seed, rate);
        REQUIRE(modes.size() == 4);
        for (std::size_t k = 0; k < 4; ++k) {
          CAPTURE(k, modes[k].frequency(), modes[k].bandwidth(), std::abs(modes[k].amplitude));
          CHECK(modes[k].frequency() == Approx(lines[k].frequency).epsilon(3e-3));
          CHECK(std::abs(modes[k].bandwidth() - lines[k].bandwidth) < 1 + 0.1 * lines[k].bandwidth);
          CHECK(std::abs(modes[k].amplitude) == Approx(lines[k].amplitude).epsilon(0.1));
        }
      }
    }
  }
}

TEST_CASE("without noise the resonances are exact", "[serial]") {
  const std::vector<Line> lines = rigid_i(2);
  const auto modes = damped_modes(ringing(lines, 100000, 0.03, 0, 1), 100000, {});
  REQUIRE(modes.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(modes[k].frequency() == Approx(lines[k].frequency).epsilon(1e-6));
    CHECK(modes[k].bandwidth() == Approx(lines[k].bandwidth).epsilon(1e-4));
    CHECK(std::abs(modes[k].amplitude) == Approx(lines[k].amplitude).epsilon(1e-4));
    CHECK(std::arg(modes[k].amplitude) == Approx(std::remainder(0.001 * lines[k].frequency, 2 * pi)).epsilon(1e-4));
  }
}

TEST_CASE("noise alone, silence and a diverged record have no resonances", "[serial]") {
  CHECK(damped_modes(ringing({}, 44100, 0.03, 1, 5), 44100, {}).size() <= 2);
  CHECK(damped_modes(std::vector<double>(2000, 0.0), 44100, {}).empty());
  CHECK(damped_modes(std::vector<double>(5, 1.0), 44100, {}).empty());
  std::vector<double> diverged(2000, 1.0);
  diverged[700] = std::numeric_limits<double>::quiet_NaN();
  CHECK(damped_modes(diverged, 44100, {}).empty());
}

TEST_CASE("a tube that reflects with -r at its open end shows its resonances to the pulse", "[serial]") {
  // Flux u at the closed end of a tube of length L: at the open end the waves of all echoes,
  //   p(t) = sum_n (-r)^n u(t - (2 n + 1) L / c),   H = e^{-i w L / c} / (1 + r e^{-2 i w L / c}),
  // so resonances at (2 k - 1) c / 4 L of bandwidth -ln(r) c / (2 pi L).
  const double length = 0.17;
  const double speed = 350;
  const double reflection = 0.97;
  const double rate = 100000;
  const GaussianFlux pulse(GaussianPulse{1, 8000});
  std::vector<double> flux;
  std::vector<double> pressure;
  for (int n = 0; n < 3500; ++n) {
    const double time = n / rate;
    flux.push_back(pulse.value(time));
    double sum = 0;
    double weight = 1;
    for (double delay = length / speed; delay < time; delay += 2 * length / speed, weight *= -reflection) {
      sum += weight * pulse.value(time - delay);
    }
    // A weak oscillation on the skirts of the resonances, which is no formant.
    sum += 1e-4 * std::exp(-pi * 100 * time) * std::sin(2 * pi * 1000 * time);
    pressure.push_back(sum);
  }
  CHECK(damped_modes(std::span(pressure).subspan(200), rate, {}).size() == 7);
  const PulseResponse response = analyse_pulse_response(flux, pressure, rate, {});
  REQUIRE(response.formants.size() == 6);
  const double bandwidth = -std::log(reflection) * speed / (2 * pi * length);
  for (std::size_t k = 0; k < 5; ++k) {
    const double frequency = (2 * static_cast<double>(k) + 1) * speed / (4 * length);
    CAPTURE(k, response.formants[k].frequency, response.formants[k].bandwidth, response.formants[k].level);
    CHECK(response.formants[k].frequency == Approx(frequency).epsilon(1e-4));
    CHECK(response.formants[k].bandwidth == Approx(bandwidth).epsilon(0.02));
    CHECK(response.formants[k].level == Approx(-20 * std::log10(1 - reflection)).margin(0.1));
  }
  // After 35 ms the tube still rings at 0.97^35 = 1/3; the transfer function must not show it. What is left are the
  // tails of the resonances above 6 kHz, which are not continued.
  const ComplexSpectrum& h = response.transfer;
  for (std::size_t k = 0; k < h.value.size() && h.frequency[k] < 5000; ++k) {
    const auto turn = std::polar(1.0, -2 * pi * h.frequency[k] * length / speed);
    const auto exact = turn / (1.0 + reflection * turn * turn);
    CHECK(std::abs(h.value[k] - exact) < 0.02 * (1 + std::abs(exact)));
  }
}

TEST_CASE("a tube without any loss keeps all of its resonances", "[serial]") {
  // As above with r = 1: modes that do not decay, so that rounding decides the sign of their bandwidth.
  const double delay = 0.17 / 350, rate = 100000;
  const GaussianFlux pulse(GaussianPulse{1, 8000});
  std::vector<double> flux, pressure;
  for (int n = 0; n < 3000; ++n) {
    const double time = n / rate;
    flux.push_back(pulse.value(time));
    double sum = 0, sign = 1;
    for (double echo = delay; echo < time; echo += 2 * delay, sign = -sign) sum += sign * pulse.value(time - echo);
    pressure.push_back(sum);
  }
  const PulseResponse response = analyse_pulse_response(flux, pressure, rate, {});
  REQUIRE(response.formants.size() >= 5);
  for (int k = 0; k < 5; ++k) {
    CHECK(response.formants[k].frequency == Approx((2 * k + 1) / (4 * delay)).epsilon(1e-4));
  }
}
