#include <filesystem>
#include <string>

#include "acoustic_solver/signals/resample.hpp"
#include "core/base/error.hpp"
#include "core/base/first_rank.hpp"
#include "core/base/mpi.hpp"
#include "core/io/signal_reader.hpp"
#include "core/io/wav.hpp"
#include "coupling/case/case_sections.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;

acoustic::GaussianPulse read_gaussian(base::Table& table) {
  acoustic::GaussianPulse pulse;
  pulse.amplitude = table.number_or("amplitude", pulse.amplitude, base::positive, "m/s");
  pulse.maximum_frequency = table.number_or("maximum_frequency", pulse.maximum_frequency, base::positive, "Hz");
  return pulse;
}

acoustic::LiljencrantsFantPulse read_liljencrants_fant(base::Table& table) {
  acoustic::LiljencrantsFantPulse pulse;
  pulse.fundamental_frequency =
      table.number_or("fundamental_frequency", pulse.fundamental_frequency, base::positive, "Hz");
  pulse.excitation = table.number_or("excitation", pulse.excitation, base::positive, "m/s^2");
  pulse.open_quotient = table.number_or("open_quotient", pulse.open_quotient, base::inside(0, 1));
  pulse.asymmetry = table.number_or("asymmetry", pulse.asymmetry, base::inside(0.5, 1));
  pulse.return_quotient = table.number_or("return_quotient", pulse.return_quotient, base::inside(0, 1));
  if (pulse.open_quotient + pulse.return_quotient >= 1) {
    throw UserError(table.place("return_quotient") + " plus open_quotient must be less than 1",
                    std::to_string(pulse.open_quotient + pulse.return_quotient), "shorten one of the two phases");
  }
  return pulse;
}

acoustic::RosenbergPulse read_rosenberg(base::Table& table) {
  acoustic::RosenbergPulse pulse;
  pulse.fundamental_frequency =
      table.number_or("fundamental_frequency", pulse.fundamental_frequency, base::positive, "Hz");
  pulse.amplitude = table.number_or("amplitude", pulse.amplitude, base::positive, "m/s");
  pulse.open_quotient = table.number_or("open_quotient", pulse.open_quotient, {.low = 0, .high = 1, .with_low = false});
  pulse.speed_quotient = table.number_or("speed_quotient", pulse.speed_quotient, base::positive);
  return pulse;
}

/// Samples of a sound file are those of a band-limited signal: four times as many make the spline through them one,
/// too.
io::Signal read_sound(const std::string& file) {
  constexpr int finer = 4;
  const io::Sound sound = io::read_wav(file);
  const double rate = sound.sampling_rate;
  io::Signal signal;
  signal.values = acoustic::resample(sound.pressure, rate, finer * rate);
  for (std::size_t n = 0; n < signal.values.size(); ++n) {
    signal.times.push_back(static_cast<double>(n) / (finer * rate));
  }
  return signal;
}

acoustic::RecordedSignal read_recorded(MPI_Comm comm, base::Table& table, const Case& config) {
  acoustic::RecordedSignal signal;
  signal.file = read_file_name(comm, table, "file", config);
  const bool is_sound = std::filesystem::path(signal.file).extension() == ".wav";
  const std::string column = is_sound ? "" : table.text_or("column", "");
  const double scale = table.number_or("scale", 1, base::any_number, "m/s per unit of the file");
  signal.fade = table.number_or("fade", signal.fade, base::not_negative, "s");
  io::Signal read;
  base::on_first_rank(comm, [&] { read = is_sound ? read_sound(signal.file) : io::read_signal(signal.file, column); });
  base::broadcast(comm, read.times);
  base::broadcast(comm, read.values);
  for (double& value : read.values) value *= scale;
  signal.times = std::move(read.times);
  signal.values = std::move(read.values);
  acoustic::RecordedFlux{signal};  // whatever is wrong with it is said before anything is built
  return signal;
}

acoustic::PulseSettings read_pulse(MPI_Comm comm, base::Table& table, const std::string& kind, const Case& config) {
  if (kind == "gaussian_pulse") return read_gaussian(table);
  if (kind == "lf") return read_liljencrants_fant(table);
  if (kind == "rosenberg") return read_rosenberg(table);
  return read_recorded(comm, table, config);
}

}  // namespace

void read_source(MPI_Comm comm, base::Table& root, Case& config) {
  auto table = root.table_if("source");
  if (!table) return;
  SourceSettings& source = config.source.emplace();
  const std::string kind = table->text("kind", {"gaussian_pulse", "lf", "rosenberg", "signal"});
  source.group = read_group(*table, config);
  config.references.back().kind = MeshReference::Kind::group_of_sound;
  source.pulse = read_pulse(comm, *table, kind, config);
  for (acoustic::AcousticSettings& solver : config.acoustics) {
    for (const acoustic::AcousticBoundary& boundary : solver.boundaries) {
      if (boundary.group != source.group) continue;
      throw UserError(
          table->place("group") + " is where the source enters, so it must not be a boundary of another kind",
          "\"" + source.group + "\" in [[acoustic.boundary]], too", "leave that boundary out");
    }
    solver.boundaries.push_back({.group = source.group, .kind = acoustic::AcousticBoundaryKind::flux});
  }
}

}  // namespace vocalis::coupling
