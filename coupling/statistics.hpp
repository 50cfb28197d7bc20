#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coupling/monitors/monitor_settings.hpp"

namespace vocalis::coupling {

enum class StatisticsKind {
  last,      ///< the value at the end of the run
  periodic,  ///< mean, amplitude and frequency of the last whole period
  extrema    ///< largest and smallest value with their times, and the last value
};

/// What a run's results say about the columns of its monitors.
struct StatisticsSettings {
  StatisticsKind kind = StatisticsKind::last;
  std::string period_of;  ///< column whose last whole period counts, for periodic
  double begin = 0;       ///< [s] what was before does not count, for periodic and extrema
};

// Series are samples at rising, perhaps uneven times [s]; both have the same length.

/// A series that is linear between its samples and constant before and after them.
double linear_at(std::span<const double> times, std::span<const double> values, double time);

/// An extremum of a series, from the parabola through the samples around it: third order in the sampling step.
struct Extremum {
  double time = 0;  ///< [s]
  double value = 0;
};
/// The largest (smallest: sign -1) value among the samples of [begin, end]; none if there is no sample.
std::optional<Extremum> extremum(std::span<const double> times, std::span<const double> values, double begin,
                                 double end, int sign);

/// Where a series rises through the middle between its extrema, (max + min) / 2 of its last period [s]. The search for
/// that period starts with all samples since `begin`, and with the later half of them as long as none is found, so that
/// a start-up may be left in. A crossing counts when the series has come from 5 % of its amplitude below to 5 % above:
/// noise smaller than that makes none.
std::vector<double> up_crossings(std::span<const double> times, std::span<const double> values, double begin);

/// The results of a run: name with unit -> value. What is not there (no period yet) is left out. With stem and unit of
/// a column:
/// last      tip_x_m
/// periodic  tip_x_mean_m = (max + min) / 2 and tip_x_amplitude_m = (max - min) / 2 over the last whole period of
///           `period_of`, as Turek & Hron 2006; tip_x_max_m, tip_x_min_m; tip_x_frequency_Hz over as many of the
///           column's own last periods as fit in there; tip_x_drift = relative change of the amplitude from the period
///           before; of pressures p_half_period_Pa, half a period after the maximum of `period_of`
/// extrema   tip_x_max_m, tip_x_max_time_s, tip_x_min_m, tip_x_min_time_s, and tip_x_m at the end
std::map<std::string, double> statistics(const StatisticsSettings& settings, std::span<const double> times,
                                         const std::vector<MonitorColumn>& columns,
                                         const std::vector<std::vector<double>>& values);

/// Throws UserError if the columns lack the one that makes the period. Every rank must pass the same.
void check_statistics(const StatisticsSettings& settings, const std::vector<std::string>& columns);

}  // namespace vocalis::coupling
