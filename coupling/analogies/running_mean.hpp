#pragma once

#include <cmath>
#include <vector>

namespace vocalis::coupling {

/// The mean of a signal that forgets: T ṁ = x - m, exact for an x that is constant over each step. What is left,
/// x - m, is x without frequencies far below 1 / (2π T): its amplitude at ω is ωT / sqrt(1 + ω²T²).
class RunningMean {
 public:
  /// time  T [s]
  explicit RunningMean(double time) : time_(time) {}
  /// The first value is the mean to begin with.
  void follow(const std::vector<double>& values, double dt) {
    if (mean_.empty()) mean_ = values;
    const double part = -std::expm1(-dt / time_);
    for (std::size_t i = 0; i < mean_.size(); ++i) mean_[i] += part * (values[i] - mean_[i]);
  }
  const std::vector<double>& mean() const { return mean_; }
  /// For checkpoints.
  std::vector<double>* memory() { return &mean_; }

 private:
  double time_;
  std::vector<double> mean_;
};

}  // namespace vocalis::coupling
