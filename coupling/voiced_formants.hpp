#pragma once

#include <span>
#include <vector>

#include "acoustic_solver/formants.hpp"

namespace vocalis::coupling {

/// Formants of a voiced sound.
///
/// pressure       [Pa]
/// sampling_rate  [Hz]
std::vector<acoustic::Formant> voiced_formants(std::span<const double> pressure, double sampling_rate);

}  // namespace vocalis::coupling
