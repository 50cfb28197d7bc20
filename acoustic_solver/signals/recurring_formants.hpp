#pragma once

#include <vector>

#include "acoustic_solver/signals/formants.hpp"

namespace vocalis::acoustic {

/// A resonance of the model of one order.
struct SeenFormant {
  Formant formant;
  int order = 0;       ///< of the model
  bool peaks = false;  ///< whether the model's |H| has a maximum within half of the bandwidth around it
};

/// The resonances that recur as the order of a model changes, rising; what only some orders see was invented by them.
/// Those of several orders are one as long as each is no further from the next than `agreement`. It counts if more than
/// half of the orders show it as a peak of |H|, or if more than three quarters have it: of two broad resonances that
/// are near, one may have no peak of its own, and no order goes without it. An order has one say, that of its narrowest
/// resonance there. Frequency, bandwidth and level are medians, `spread` is half of the range of the frequencies.
///
/// seen       in any order
/// orders     how many models there are
/// agreement  relative to the frequency
/// Source: McCandless 1974, IEEE Trans. Acoust. Speech Signal Process. 22 (formants are peaks of the model's spectrum);
/// Peeters & De Roeck 2001, J. Dyn. Syst. Meas. Control 123 (poles that are stable over the order).
std::vector<Formant> recurring_formants(std::vector<SeenFormant> seen, int orders, double agreement);

}  // namespace vocalis::acoustic
