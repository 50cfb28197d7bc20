#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "coupling/phonation/glottal_cycle.hpp"

namespace vocalis::coupling {

/// What a phonating larynx recorded: as many values as times, or none.
struct PhonationSeries {
  std::span<const double> times = {};          ///< [s] rising, perhaps uneven
  std::span<const double> opening = {};        ///< of the glottis: its area [m^2], or its width [m]; 0 when closed
  std::span<const double> flow = {};           ///< of air out of the larynx [m^3/s; m^2/s]
  std::span<const double> glottal_flow = {};   ///< relative to the folds, same unit
  std::span<const double> speed = {};          ///< the largest one of the air [m/s]
  std::span<const double> impact_stress = {};  ///< [Pa]
  std::vector<std::span<const double>> displacements = {};  ///< [m], each one component of a point
};

/// The figures of one cycle. Those of flow, speed, stress and displacement are taken from `begin` to `end`.
struct CycleFigures {
  GlottalCycle cycle;
  double frequency = 0;                 ///< 1 / period [Hz]
  double open_quotient = 1;             ///< time open / period; 1 if the folds do not close
  double wide_quotient = 1;             ///< time with more than a fifth of the opening's range / period
  double closing_quotient = 0;          ///< (closes - peak) / period
  double speed_quotient = 0;            ///< (peak - opens) / (closes - peak)
  std::optional<double> peak_flow;      ///< the largest
  std::optional<double> mean_flow;      ///< ∫ flow dt / period
  std::optional<double> declination;    ///< largest fall of the flow, see `flow_declination` [m^3/s^2; m^2/s^2]
  std::optional<double> peak_speed;     ///< the largest speed of the air
  std::optional<double> jet_speed;      ///< peak_flow over the opening at that instant [m/s]; none if it is closed
  std::optional<double> leak;           ///< largest |glottal flow| while closed, over peak_flow; none if it is never
  std::optional<double> impact_stress;  ///< the largest
  std::vector<double> amplitudes;       ///< (largest - smallest) / 2 of each displacement
};

/// `wide_quotient` is what cameras and flow masks, which do not see a narrow slit, take for the open quotient.
/// Sources: open quotient and speed quotient Timcke, von Leden & Moore 1958 (Arch. Otolaryngol. 68, 1); of area and
/// flow, closing quotient and maximum flow declination rate Holmberg, Hillman & Perkell 1988 (J. Acoust. Soc. Am. 84,
/// 511); Titze 2000, Principles of Voice Production.
CycleFigures measure_cycle(const GlottalCycle& cycle, const PhonationSeries& series);

/// The steepest fall of a flow in an interval: of its differences over a fifth of a millisecond, which lets pass what
/// is below 2 kHz, as flow masks do. A flow that contact shuts off between two steps would have no finite slope.
double flow_declination(std::span<const double> times, std::span<const double> flow, double begin, double end);

/// (largest - smallest) / mean: how far figures of several cycles lie apart.
double spread(std::span<const double> values);

}  // namespace vocalis::coupling
