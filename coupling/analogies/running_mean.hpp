#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace vocalis::coupling {

/// The mean of a signal that forgets: T ṁ = x - m, exact for an x that is constant over each step. What is left,
/// x - m, is x without frequencies far below 1 / (2π T): its amplitude at ω is ωT / sqrt(1 + ω²T²). As long as it has
/// followed for less than T it is the mean since the start, so that no value at the start weighs more than another.
class RunningMean {
 public:
  /// time  T [s]
  explicit RunningMean(double time) : time_(time) {}
  void follow(const std::vector<double>& values, double dt) {
    mean_.resize(values.size());
    followed_[0] += dt;
    const double part = std::max(-std::expm1(-dt / time_), dt / followed_[0]);
    for (std::size_t i = 0; i < mean_.size(); ++i) mean_[i] += part * (values[i] - mean_[i]);
  }
  const std::vector<double>& mean() const { return mean_; }
  /// For checkpoints.
  std::vector<std::vector<double>*> memory() { return {&mean_, &followed_}; }

 private:
  double time_;
  std::vector<double> mean_;
  std::vector<double> followed_ = {0};  ///< [s], one
};

}  // namespace vocalis::coupling
