#include "core/io/wav.hpp"

#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "core/base/error.hpp"

namespace vocalis::io {

namespace {

struct CloseFile {
  void operator()(SNDFILE* file) const { sf_close(file); }
};
using File = std::unique_ptr<SNDFILE, CloseFile>;

const std::string scale_label = "sample 1.0 is ";  // the comment: "sample 1.0 is 0.25 Pa"

double largest_magnitude(std::span<const double> pressure) {
  double largest = 0;
  for (double value : pressure) {
    if (!std::isfinite(value)) {
      throw base::UserError("a sound must be finite", fmt::format("{} Pa", value),
                            "look for the step at which the run diverged, in history.csv");
    }
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

base::UserError writing_failed(const std::string& path, const char* reason) {
  return {"the sound file must be writable", path + " (" + reason + ")", "check the folder, its rights and the disk"};
}

}  // namespace

double write_wav(const std::string& path, std::span<const double> pressure, const WavSettings& settings) {
  const double largest = largest_magnitude(pressure);
  const bool integers = settings.format == WavSettings::Format::int16;
  // 16 bits: 1 dB below full scale, since players that resample overshoot between the samples.
  const double full_scale = !integers ? settings.full_scale : largest > 0 ? largest / 0.89 : 1.0;
  if (!(full_scale > 0)) {
    throw base::UserError("full_scale of a sound file must be positive [Pa]", fmt::format("{}", full_scale), "use 1");
  }
  SF_INFO info{};
  info.samplerate = settings.sampling_rate;
  info.channels = 1;
  info.format = SF_FORMAT_WAV | (integers ? SF_FORMAT_PCM_16 : SF_FORMAT_FLOAT);
  const File file(sf_open(path.c_str(), SFM_WRITE, &info));
  if (!file) throw writing_failed(path, sf_strerror(nullptr));
  // A peak chunk carries the date, and the same run would give different bytes.
  sf_command(file.get(), SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE);
  const std::string comment = fmt::format("{}{:.17g} Pa", scale_label, full_scale);
  sf_set_string(file.get(), SF_STR_COMMENT, comment.c_str());
  std::vector<double> samples(pressure.begin(), pressure.end());
  for (double& sample : samples) sample /= full_scale;
  const auto count = static_cast<sf_count_t>(samples.size());
  if (sf_write_double(file.get(), samples.data(), count) != count) {
    throw writing_failed(path, sf_strerror(file.get()));
  }
  return full_scale;
}

Sound read_wav(const std::string& path) {
  SF_INFO info{};
  const File file(sf_open(path.c_str(), SFM_READ, &info));
  if (!file) {
    throw base::UserError("the sound file must be readable", path + " (" + sf_strerror(nullptr) + ")",
                          "give a WAV file that exists");
  }
  Sound sound;
  sound.sampling_rate = info.samplerate;
  const char* comment = sf_get_string(file.get(), SF_STR_COMMENT);
  if (comment != nullptr) sound.comment = comment;
  double full_scale = 1;
  if (sound.comment.rfind(scale_label, 0) == 0) {
    full_scale = std::strtod(sound.comment.c_str() + scale_label.size(), nullptr);
  }
  std::vector<double> samples(static_cast<std::size_t>(info.frames) * static_cast<std::size_t>(info.channels));
  const sf_count_t read = sf_readf_double(file.get(), samples.data(), info.frames);
  sound.pressure.reserve(static_cast<std::size_t>(read));
  for (sf_count_t n = 0; n < read; ++n) {
    sound.pressure.push_back(full_scale * samples[static_cast<std::size_t>(n * info.channels)]);
  }
  return sound;
}

}  // namespace vocalis::io
