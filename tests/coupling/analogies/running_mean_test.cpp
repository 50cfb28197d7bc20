#include "coupling/analogies/running_mean.hpp"

#include <catch2/catch.hpp>

using namespace vocalis::coupling;

TEST_CASE("a running mean is a plain one up to T, and then forgets as exp(-t / T), at any steps", "[serial]") {
  RunningMean mean(2.0);
  mean.follow({5, -1}, 0.1);
  CHECK(mean.mean() == std::vector<double>{5, -1});
  mean.follow({1, -1}, 0.5);
  mean.follow({4, -1}, 1.2);
  const double plain = (0.1 * 5 + 0.5 * 1 + 1.2 * 4) / 1.8;
  CHECK(mean.mean()[0] == Approx(plain).epsilon(1e-12));
  double time = 0;
  for (const double dt : {3.0, 0.01, 0.5}) {
    mean.follow({1, -1}, dt);
    time += dt;
    CHECK(mean.mean()[0] == Approx(1 + (plain - 1) * std::exp(-time / 2)).epsilon(1e-12));
    CHECK(mean.mean()[1] == -1);
  }
}

TEST_CASE("what a running mean leaves of a wave is the part that its docstring tells", "[serial]") {
  const double omega = 3, T = 0.7, dt = 1e-3;
  RunningMean mean(T);
  double largest = 0;
  for (int n = 0; n * dt < 20; ++n) {
    const double x = std::sin(omega * (n + 0.5) * dt);
    mean.follow({x}, dt);
    if (n * dt > 15) largest = std::max(largest, std::abs(x - mean.mean()[0]));
  }
  CHECK(largest == Approx(omega * T / std::sqrt(1 + omega * omega * T * T)).epsilon(2e-3));
}
