#include "coupling/sound/sound_table.hpp"

#include <algorithm>
#include <cmath>

namespace vocalis::coupling {

namespace {

constexpr std::size_t most_harmonics = 20;

/// A number in a field of ten, or a dash where there is none.
std::string field(double value) { return std::isfinite(value) ? fmt::format("{:>10.1f}", value) : "         -"; }

void print_formants(base::Log& log, const SoundAnalysis& analysis) {
  log.info("  formants by {}{}", analysis.method, analysis.formants.empty() ? ": none" : "");
  if (analysis.formants.empty()) return;
  const bool has_level = !analysis.transfer_level.empty();
  const bool has_spread = std::isfinite(analysis.formants.front().spread);
  log.info("      frequency [Hz]  bandwidth [Hz]{}{}", has_level ? "  pressure over source [dB]" : "",
           has_spread ? "  spread [Hz]" : "");
  for (std::size_t i = 0; i < analysis.formants.size(); ++i) {
    const acoustic::Formant& formant = analysis.formants[i];
    log.info("  F{:<2}    {}      {}{}{}", i + 1, field(formant.frequency), field(formant.bandwidth),
             has_level ? "                 " + field(formant.level) : "",
             has_spread ? "   " + field(formant.spread) : "");
  }
}

void print_harmonics(base::Log& log, const std::vector<acoustic::Harmonic>& harmonics) {
  if (harmonics.empty()) return;
  const std::size_t shown = std::min(harmonics.size(), most_harmonics);
  log.info("  harmonics{}",
           shown < harmonics.size() ? fmt::format(", the first {} of {}", shown, harmonics.size()) : "");
  log.info("      frequency [Hz]      level [dB]");
  for (std::size_t i = 0; i < shown; ++i) {
    log.info("  {:<3}   {}      {}", harmonics[i].number, field(harmonics[i].frequency), field(harmonics[i].level));
  }
}

}  // namespace

void print_sounds(base::Log& log, const std::vector<ChannelSound>& sounds) {
  for (const ChannelSound& sound : sounds) {
    const SoundAnalysis& analysis = sound.analysis;
    log.info("microphone {}: {:.1f} dB re 20 uPa, {}", sound.channel.suffix, analysis.level,
             analysis.pitch ? fmt::format("f0 {:.2f} Hz", *analysis.pitch) : "no pitch");
    print_formants(log, analysis);
    print_harmonics(log, analysis.harmonics);
    log.info("");
  }
}

}  // namespace vocalis::coupling
