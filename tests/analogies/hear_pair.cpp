#include "tests/analogies/hear_pair.hpp"

#include <cmath>
#include <cstdio>
#include <memory>

#include "core/base/mpi.hpp"
#include "tests/analogies/exact_sound.hpp"

namespace vocalis::coupling::test {

namespace {

/// Of ∂t p_ic the first leaves 1.0004 of the amplitude (docs/theory.md).
SourceWindow window(const SpinningPair& pair, const std::string& analogy) {
  if (needs_near_field(analogy)) return {0.25 * pair.wavelength(), pair.flow_radius() - 0.25 * pair.wavelength()};
  return {5 * pair.orbit, pair.orbit};
}

/// What the analogy must give, over the formula.
std::complex<double> exact(const SpinningPair& pair, const Model& model) {
  const bool is_ape = model.analogy == "ape", in_flow = model.convection && (is_ape || model.analogy == "pcwe");
  const auto source = window(pair, model.analogy);
  const auto sound = in_flow ? exact_in_flow(pair, model.analogy, source, true, 2)
                             : exact_at_rest(pair, is_ape ? "vortex" : model.analogy, source);
  const std::complex<double> turns(0, 2 * M_PI * model.mean_periods);
  return is_ape ? sound * turns / (1.0 + turns) : sound;  // less the running mean
}

Case disc(const SpinningPair& pair, const Resolution& resolution) {
  Case config;
  config.flow.emplace();
  config.mesh.file = VOCALIS_SOURCE_DIR "/cases/vortex_pair/disc.geo";
  config.mesh.is_geometry = true;
  config.mesh.parameters = {{"orbit", pair.orbit},
                            {"flow_radius", pair.flow_radius()},
                            {"air_radius", 2 * pair.wavelength()},
                            {"h_path", pair.core_radius / resolution.cells_a_core},
                            {"growth", resolution.growth},
                            {"h_air", pair.wavelength() / resolution.cells_a_wavelength}};
  config.regions = {{"flow", RegionKind::fluid}, {"air", RegionKind::air}};
  for (const Region& region : config.regions) {
    config.references.push_back({MeshReference::Kind::region, "region", region.name, {}});
  }
  const double r = 1.6 * pair.wavelength();  // beyond the flow
  for (const double theta : {0.2, 1.3}) {
    const std::string name = "at_" + std::to_string(config.microphones.size());
    config.microphones.push_back({name, {r * std::cos(theta), r * std::sin(theta), 0}});
  }
  return config;
}

acoustic::AcousticSettings settings(const SpinningPair& pair, const Model& model, double dt) {
  acoustic::AcousticSettings result;
  result.density = pair.density;
  result.speed_of_sound = pair.speed_of_sound;
  result.step = dt;
  result.boundaries = {
      {.group = "open", .kind = acoustic::AcousticBoundaryKind::open, .radius = 2 * pair.wavelength()}};
  result.analogy.name = model.analogy;
  result.analogy.convection = model.convection;
  result.analogy.fade_in = 1.5 * pair.period();
  result.analogy.mean_flow = model.analogy == "ape";
  result.analogy.mean_time = model.mean_periods * pair.period();
  result.analogy.window_radius = window(pair, model.analogy).radius;
  result.analogy.window_width = window(pair, model.analogy).width;
  return result;
}

/// Amplitude and phase of the wave of 2ω in the last two periods, weighed by Hann's window, over C of the formula.
std::complex<double> wave(const SpinningPair& pair, const acoustic::Microphones::Block& block, std::size_t microphone,
                          std::size_t microphones) {
  const double end = block.times.back(), length = 2 * pair.period(), omega = 2 * pair.angular_velocity();
  std::complex<double> sum = 0;
  double weights = 0;
  for (std::size_t sample = 0; sample < block.times.size(); ++sample) {
    const double t = block.times[sample];
    if (t < end - length) continue;
    const double weight = 1 - std::cos(2 * M_PI * (end - t) / length);
    sum += weight * block.values[sample * microphones + microphone] * std::polar(2.0, -omega * t);
    weights += weight;
  }
  return sum / weights;
}

/// What is heard over the formula's, mean of the microphones, on every rank. Collective.
std::complex<double> over_formula(const SpinningPair& pair, const Case& config, Voice& voice) {
  const auto block = voice.microphones().collect();
  std::complex<double> mean = 0;
  if (base::rank(MPI_COMM_WORLD) == 0) {
    const std::size_t microphones = config.microphones.size();
    for (std::size_t m = 0; m < microphones; ++m) {
      const auto& at = config.microphones[m].position;
      mean += wave(pair, block, m, microphones) / far_field(pair, std::hypot(at[0], at[1]), std::atan2(at[1], at[0])) /
              static_cast<double>(microphones);
    }
  }
  MPI_Bcast(&mean, 2, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return mean;
}

void print(const Heard& heard) {
  if (base::rank(MPI_COMM_WORLD) > 0) return;
  const std::string name = heard.model.analogy + (heard.model.convection ? "" : " at rest");
  const auto off = heard.wave / heard.exact;
  std::printf("  %-13s  heard %+6.2f %% %+5.2f deg  exact %+6.2f %% %+5.2f deg  apart %+5.2f %% %+5.2f deg  %5.1f s\n",
              name.c_str(), 100 * (std::abs(heard.wave) - 1), degrees(heard.wave), 100 * (std::abs(heard.exact) - 1),
              degrees(heard.exact), 100 * (std::abs(off) - 1), degrees(off), heard.seconds);
}

}  // namespace

std::vector<Heard> listen(const SpinningPair& pair, const std::vector<Model>& models, const Resolution& resolution,
                          int periods) {
  Case config = disc(pair, resolution);
  const double dt = pair.period() / resolution.steps_a_period;
  for (const Model& model : models) config.acoustics.push_back(settings(pair, model, dt));
  const auto scene = build_scene(MPI_COMM_WORLD, config);
  std::vector<std::unique_ptr<Voice>> owners;
  std::vector<Voice*> voices;
  for (const auto& one : config.acoustics) {
    owners.push_back(std::make_unique<Voice>(*scene, config, one, voices.empty() ? nullptr : voices.front()));
    voices.push_back(owners.back().get());
  }
  Lead lead(*scene, made_flow(pair), dt);
  for (int n = 0; n < periods * resolution.steps_a_period; ++n) lead.step(voices);
  std::vector<Heard> result;
  for (std::size_t i = 0; i < voices.size(); ++i) {
    result.push_back(
        {models[i], over_formula(pair, config, *voices[i]), exact(pair, models[i]), lead.seconds(*voices[i])});
    print(result.back());
  }
  return result;
}

}  // namespace vocalis::coupling::test
