#include "acoustic_solver/signals/fourier.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cassert>
#include <memory>

namespace vocalis::acoustic {

namespace {

struct DestroyPlan {
  void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
};
using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, DestroyPlan>;

fftw_complex* as_fftw(std::vector<std::complex<double>>& values) {
  return reinterpret_cast<fftw_complex*>(values.data());  // FFTW promises this layout
}

}  // namespace

std::vector<std::complex<double>> fourier_transform(std::span<const double> series, int length) {
  assert(length > 0);
  std::vector<double> input(static_cast<std::size_t>(length), 0.0);
  std::copy_n(series.begin(), std::min(series.size(), input.size()), input.begin());
  std::vector<std::complex<double>> output(static_cast<std::size_t>(length / 2 + 1));
  // FFTW_ESTIMATE measures nothing, so that the same series gives the same bits in every run.
  const Plan plan(fftw_plan_dft_r2c_1d(length, input.data(), as_fftw(output), FFTW_ESTIMATE));
  fftw_execute(plan.get());
  return output;
}

std::vector<double> inverse_fourier_transform(std::span<const std::complex<double>> spectrum, int length) {
  assert(length > 0 && spectrum.size() == static_cast<std::size_t>(length / 2 + 1));
  std::vector<std::complex<double>> input(spectrum.begin(), spectrum.end());
  std::vector<double> output(static_cast<std::size_t>(length));
  const Plan plan(fftw_plan_dft_c2r_1d(length, as_fftw(input), output.data(), FFTW_ESTIMATE));
  fftw_execute(plan.get());
  for (double& value : output) value /= length;
  return output;
}

int padded_length(double count) {
  int length = 1;
  while (length < count) length *= 2;
  return length;
}

}  // namespace vocalis::acoustic
