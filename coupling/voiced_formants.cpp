#include "coupling/voiced_formants.hpp"

namespace vocalis::coupling {

std::vector<acoustic::Formant> voiced_formants(std::span<const double> pressure, double sampling_rate) {
  return acoustic::formants_by_prediction(pressure, sampling_rate, {});
}

}  // namespace vocalis::coupling
