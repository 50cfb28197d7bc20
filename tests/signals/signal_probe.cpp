// Shows the signal processing of Vocalis to scripts that hold it against other programs: one number or row a line.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "acoustic_solver/signals/driven_response.hpp"
#include "acoustic_solver/signals/formants.hpp"
#include "acoustic_solver/signals/resample.hpp"
#include "acoustic_solver/signals/spectrum.hpp"
#include "acoustic_solver/signals/voice.hpp"
#include "acoustic_solver/sources/rosenberg.hpp"
#include "core/io/wav.hpp"
#include "tests/acoustic_solver/signals/synthetic_vowel.hpp"

using namespace vocalis;

namespace {

const char* const usage =
    "usage: signal_probe vowel NUMBER PITCH OUT.wav | formants FILE | pitch FILE | level FILE | welch FILE SEGMENT |\n"
    "  response FLOW SOUND | resample FILE RATE | harmonics FILE PITCH\n";

/// Half a second of one of the ten vowels, sung by Rosenberg's pulses; about 0.1 Pa. It fades in and out over 50 ms:
/// without that weak formants move in Praat, those of /u/ at 220 Hz by 6.6 %.
void write_vowel(int number, double pitch, const std::string& path) {
  constexpr double rate = 44100;
  const auto& vowel = synthetic::vowels.at(static_cast<std::size_t>(number));
  const auto flux = synthetic::samples(acoustic::RosenbergFlux({.fundamental_frequency = pitch}), rate, 0.5);
  std::vector<double> sound = synthetic::sound(flux, synthetic::tract(vowel), rate);
  for (std::size_t n = 0; n < sound.size(); ++n) {
    const double from_end = static_cast<double>(std::min(n, sound.size() - 1 - n)) / rate;
    sound[n] *= 1e-4 * std::pow(std::sin(0.5 * std::numbers::pi * std::min(1.0, from_end / 0.05)), 2);
  }
  io::write_wav(path, sound);
}

void print_formants(const io::Sound& sound) {
  for (const auto& formant : acoustic::formants_by_prediction(sound.pressure, sound.sampling_rate, {})) {
    fmt::print("{:.17g} {:.17g}\n", formant.frequency, formant.bandwidth);
  }
}

void print_driven_formants(const io::Sound& flow, const io::Sound& sound) {
  for (const auto& formant : acoustic::driven_response(flow.pressure, sound.pressure, sound.sampling_rate).formants) {
    fmt::print("{:.17g} {:.17g} {:.17g}\n", formant.frequency, formant.bandwidth, formant.spread);
  }
}

int probe(const std::vector<std::string>& words) {
  const std::string& command = words[0];
  if (command == "vowel" && words.size() == 4) {
    write_vowel(std::stoi(words[1]), std::stod(words[2]), words[3]);
    return 0;
  }
  const io::Sound sound = io::read_wav(words[1]);
  const double rate = sound.sampling_rate;
  if (command == "formants") {
    print_formants(sound);
  } else if (command == "pitch") {
    fmt::print("{:.17g}\n", acoustic::fundamental_frequency(sound.pressure, rate).frequency.value_or(0));
  } else if (command == "level") {
    fmt::print("{:.17g}\n", acoustic::sound_pressure_level(sound.pressure));
  } else if (command == "welch" && words.size() == 3) {
    const auto power = acoustic::welch(sound.pressure, rate, std::stoi(words[2]));
    for (std::size_t k = 0; k < power.density.size(); ++k) {
      fmt::print("{:.17g} {:.17g}\n", power.frequency[k], power.density[k]);
    }
  } else if (command == "response" && words.size() == 3) {
    print_driven_formants(sound, io::read_wav(words[2]));
  } else if (command == "resample" && words.size() == 3) {
    for (const double value : acoustic::resample(sound.pressure, rate, std::stod(words[2])))
      fmt::print("{:.17g}\n", value);
  } else if (command == "harmonics" && words.size() == 3) {
    for (const auto& line : acoustic::harmonics(sound.pressure, rate, std::stod(words[2]), 6000)) {
      fmt::print("{:.17g} {:.17g} {:.17g}\n", line.frequency, line.amplitude, line.level);
    }
  } else {
    return 2;
  }
  return 0;
}

}  // namespace

int main(int count, char** words) {
  const int code = count < 3 ? 2 : probe({words + 1, words + count});
  if (code != 0) std::fputs(usage, stderr);
  return code;
}
