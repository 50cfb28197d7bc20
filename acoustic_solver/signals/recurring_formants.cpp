#include "acoustic_solver/signals/recurring_formants.hpp"

#include <algorithm>
#include <map>
#include <span>

namespace vocalis::acoustic {

namespace {

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// The narrowest resonance of each order.
std::vector<Formant> one_of_each_order(std::span<const SeenFormant> seen) {
  std::map<int, Formant> narrowest;
  for (const SeenFormant& one : seen) {
    const auto [place, is_first] = narrowest.try_emplace(one.order, one.formant);
    if (!is_first && one.formant.bandwidth < place->second.bandwidth) place->second = one.formant;
  }
  std::vector<Formant> result;
  for (const auto& [order, formant] : narrowest) result.push_back(formant);
  return result;
}

int orders_that_show_peak(std::span<const SeenFormant> seen) {
  std::map<int, bool> shows;
  for (const SeenFormant& one : seen) shows[one.order] = shows[one.order] || one.peaks;
  return static_cast<int>(std::count_if(shows.begin(), shows.end(), [](const auto& order) { return order.second; }));
}

Formant middle(const std::vector<Formant>& formants) {
  std::vector<double> frequencies, bandwidths, levels;
  for (const Formant& formant : formants) {
    frequencies.push_back(formant.frequency);
    bandwidths.push_back(formant.bandwidth);
    levels.push_back(formant.level);
  }
  const auto [least, most] = std::minmax_element(frequencies.begin(), frequencies.end());
  const double spread = 0.5 * (*most - *least);
  return {median(frequencies), median(bandwidths), median(levels), spread};
}

}  // namespace

std::vector<Formant> recurring_formants(std::vector<SeenFormant> seen, int orders, double agreement) {
  std::sort(seen.begin(), seen.end(),
            [](const SeenFormant& a, const SeenFormant& b) { return a.formant.frequency < b.formant.frequency; });
  std::vector<Formant> result;
  for (std::size_t begin = 0; begin < seen.size();) {
    std::size_t end = begin + 1;
    const auto frequency = [&](std::size_t i) { return seen[i].formant.frequency; };
    while (end < seen.size() && frequency(end) - frequency(end - 1) < agreement * frequency(end)) ++end;
    const std::span<const SeenFormant> near(seen.data() + begin, end - begin);
    const std::vector<Formant> votes = one_of_each_order(near);
    const bool is_in_most = 4 * static_cast<int>(votes.size()) > 3 * orders;
    if (is_in_most || 2 * orders_that_show_peak(near) > orders) result.push_back(middle(votes));
    begin = end;
  }
  return result;
}

}  // namespace vocalis::acoustic
