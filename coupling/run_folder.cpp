#include "coupling/run_folder.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "coupling/far_field/surface_series.hpp"
#include "coupling/figures.hpp"
#include "coupling/flow/recorded_flow.hpp"

namespace vocalis::coupling {

namespace {

using Header = io::SeriesWriter::Header;

std::vector<std::string> history_columns(const Simulation& simulation) {
  std::vector<std::string> columns = {
      "step", "time_s", "dt_s", "newton_iterations", "jacobians", "acoustic_iterations", "smallest_quality"};
  if (simulation.clock().tolerance > 0) columns.push_back("local_error");
  if (simulation.monitors()) {
    const auto& more = simulation.monitors()->columns();
    columns.insert(columns.end(), more.begin(), more.end());
  }
  return columns;
}

std::vector<std::string> microphone_columns(const Case& config, std::size_t solver) {
  std::vector<std::string> columns = {"time_s"};
  if (config.source) columns.push_back(source_column);
  for (const Channel& channel : channels(config)) {
    if (channel.solver != config.acoustics[solver].name) continue;
    columns.push_back(channel.column);
    if (!config.has_flow()) continue;
    columns.push_back("p_a_Pa." + channel.suffix);
    columns.push_back("p_ic_Pa." + channel.suffix);
  }
  return columns;
}

std::string words(const acoustic::MicrophoneSettings& microphone) {
  if (microphone.kind == acoustic::MicrophoneKind::mesh) return "on the mesh";
  std::string mirrors;
  for (const acoustic::MirrorPlane& mirror : microphone.mirrors) {
    mirrors += fmt::format(", mirrored at {} = {} m", "xyz"[mirror.axis], mirror.position);
  }
  return fmt::format("far field, by Kirchhoff's integral over '{}'{}", microphone.surface, mirrors);
}

std::string meaning_of_sound(const std::string& analogy) {
  if (analogy == "lighthill" || analogy == "vortex" || analogy == "ape") {
    return "pressure of the wave equation, which is for the whole, less p_ic";
  }
  return "acoustic pressure, of the wave equation with the analogy's source";
}

/// What a reader of the file alone must know: units, what p is, of which medium, where.
Header microphone_header(const Case& config, std::size_t solver, const std::vector<std::int32_t>& in_flow) {
  const acoustic::AcousticSettings& settings = config.acoustics[solver];
  Header header = {{"case", config.name},
                   {"solver", settings.name},
                   {"units", "SI: times [s], instantaneous pressures [Pa], positions [m], speeds [m/s]"}};
  if (config.has_flow()) {
    header.emplace_back("pressure_Pa", "p_a + p_ic, the whole deviation from the pressure at rest");
    header.emplace_back("p_a_Pa", meaning_of_sound(settings.analogy.name));
    header.emplace_back("p_ic_Pa", "pressure of the incompressible flow, linear in time over a step of the flow");
    header.emplace_back("analogy", settings.analogy.name);
    header.emplace_back("sign", "p_a adds to p_ic; the mass source of pressure_rate is -(1 / (rho c^2)) dp_ic/dt");
  } else {
    header.emplace_back("pressure_Pa", "acoustic pressure, of the wave equation driven by source_m_s");
    header.emplace_back("analogy", "none");
    header.emplace_back("sign", "source_m_s is positive into the air");
  }
  header.emplace_back("speed_of_sound_m_s", fmt::format("{}", settings.speed_of_sound));
  header.emplace_back("density_kg_m3", fmt::format("{}", settings.density));
  for (std::size_t m = 0; m < config.microphones.size(); ++m) {
    const acoustic::MicrophoneSettings& microphone = config.microphones[m];
    const auto& [x, y, z] = microphone.position;
    header.emplace_back("position_m." + microphone.name, fmt::format("{} {} {}", x, y, z));
    header.emplace_back("microphone." + microphone.name, words(microphone));
    if (!config.has_flow()) continue;
    header.emplace_back("p_ic." + microphone.name, in_flow[m] ? "inside of the flow" : "0: outside of the flow");
  }
  return header;
}

/// A step, its time, and the opening at each station: "opening_m.0.0123" where x = 0.0123 m.
std::vector<std::string> kymogram_columns(const Stations& stations) {
  std::vector<std::string> columns = {"step", "time_s"};
  for (int i = 0; i < stations.count; ++i) columns.push_back(fmt::format("opening_m.{:.9g}", stations.place(i)));
  return columns;
}

Header kymogram_header(const Case& config, const Glottis& glottis) {
  return {
      {"case", config.name},
      {"monitor", glottis.settings.name},
      {"opening_m", fmt::format("distance of the folds [m], 0 where contact cells seal them; in space the mean over "
                                "their length. Of each column at this {} [m]",
                                "xyz"[glottis.grid.along.axis])}};
}

/// Whether a multiple of the interval [s] lies in the step that ended now.
bool is_due(double time, double dt, double interval) {
  return interval > 0 && std::floor((time + 1e-9 * dt) / interval) > std::floor((time - dt + 1e-9 * dt) / interval);
}

std::unique_ptr<io::SeriesWriter> open_series(MPI_Comm comm, const std::string& path, const Header& header,
                                              const std::vector<std::string>& columns, int column, double last,
                                              bool goes_on) {
  if (goes_on) return std::make_unique<io::SeriesWriter>(io::SeriesWriter::resume(comm, path, columns, column, last));
  return std::make_unique<io::SeriesWriter>(comm, path, header, columns);
}

/// Whether a run writes files of this name.
bool is_of_a_run(const std::string& name) {
  for (const char* known : {"checkpoint.h5", "summary.json", "report.html", "spectra.csv", "harmonics.csv", "fields.h5",
                            "fields.xdmf", "periods.csv", "flow_record.h5"}) {
    if (name == known) return true;
  }
  if (name.starts_with("kymogram_") && name.ends_with(".csv")) return true;
  return name.starts_with("microphone") && (name.ends_with(".wav") || name.ends_with(".csv"));
}

}  // namespace

void prepare_run_folder(MPI_Comm comm, const std::string& folder) {
  std::vector<char> problem;
  if (base::rank(comm) == 0) {
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    if (!std::filesystem::is_directory(folder)) {
      const std::string text = code ? code.message() : "a file of that name";
      problem.assign(text.begin(), text.end());
    } else {
      std::vector<std::filesystem::path> old;
      for (std::filesystem::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
        if (is_of_a_run(entry->path().filename().string())) old.push_back(entry->path());
      }
      for (const auto& path : old) std::filesystem::remove(path, code);
    }
  }
  base::broadcast(comm, problem);
  if (!problem.empty()) {
    throw base::UserError("the run folder must be a folder that can be made: " + folder,
                          std::string(problem.begin(), problem.end()), "choose another with --out DIR");
  }
}

RunOutput::RunOutput(const Case& config, const std::string& folder, const Scene& scene, Simulation& simulation,
                     bool goes_on)
    : config_(config), scene_(scene) {
  const MPI_Comm comm = scene.parent.comm;
  const Clock& clock = simulation.clock();
  const std::filesystem::path path = folder;
  history_ = open_series(comm, path / "history.csv", {{"case", config.name}}, history_columns(simulation), 0,
                         static_cast<double>(clock.step), goes_on);
  if (simulation.monitors() && config.output.kymogram_interval > 0) {
    for (const Glottis* glottis : simulation.monitors()->glottises()) {
      kymograms_.push_back(open_series(comm, path / ("kymogram_" + glottis->settings.name + ".csv"),
                                       kymogram_header(config, *glottis), kymogram_columns(glottis->grid.along), 0,
                                       static_cast<double>(clock.step), goes_on));
    }
  }
  if (!config.microphones.empty()) {
    for (std::size_t i = 0; i < config.acoustics.size(); ++i) {
      const std::vector<std::int32_t> in_flow = simulation.voices()[i]->in_flow();
      microphones_.push_back(open_series(comm, path / microphones_file(config, i),
                                         microphone_header(config, i, in_flow), microphone_columns(config, i), 0,
                                         clock.time * (1 + 1e-12), goes_on));
    }
  }
  if (!config.surface_microphones.empty()) {
    surface_microphones_ = open_surface_series(comm, config, folder, clock.time * (1 + 1e-12), goes_on);
  }
  if (scene.flow) vertex_is_wet_ = mesh::mark_vertices_of_cells(scene.flow->mesh, fluid_cells(scene));
  if (config.record) {
    const std::string file = path / "flow_record.h5";
    const mesh::Mesh& mesh = scene.flow->mesh;
    const RecordedParts parts = {.edges = config.flow && config.flow->elements == fsi::Elements::p2p1,
                                 .displacement = config.flow && !config.flow->solids.empty(),
                                 .contact = simulation.history()->can_close()};
    record_layout_ = layout_of_flow(mesh.dimension, parts, config.record->precision == Precision::single);
    flow_record_ = std::make_unique<io::RecordWriter>(
        goes_on ? io::RecordWriter::resume(file, mesh, record_layout_, clock.step + 1)
                : io::RecordWriter(file, mesh, record_layout_));
    if (!goes_on) record_flow(simulation);
  }
  if (config.output.fields_interval > 0) {
    parent_space_ = fem::lagrange(scene.parent, 1);
    if (scene.flow) {
      flow_space_ = fem::lagrange(scene.flow->mesh, 1);
      flow_to_parent_.emplace(transfer::SharedVertices::to_parent(scene.parent, *scene.flow));
    }
    fields_ =
        std::make_unique<io::FieldsWriter>(goes_on ? io::FieldsWriter::resume(comm, folder, scene.parent, clock.step)
                                                   : io::FieldsWriter(comm, folder, scene.parent));
    if (!goes_on) write_fields(simulation);
  }
}

void RunOutput::record(Simulation& simulation, const StepOutcome& outcome) {
  const Clock& clock = simulation.clock();
  std::vector<double> row = {static_cast<double>(clock.step),
                             clock.time,
                             outcome.dt,
                             static_cast<double>(outcome.newton_iterations),
                             static_cast<double>(outcome.jacobians),
                             static_cast<double>(outcome.acoustic_iterations),
                             outcome.smallest_quality};
  if (clock.tolerance > 0) row.push_back(outcome.local_error);
  const std::vector<double> monitors = simulation.monitor_values();
  row.insert(row.end(), monitors.begin(), monitors.end());
  history_->write(row);
  if (clock.step % 100 == 0) record_microphones(simulation);
  if (flow_record_) record_flow(simulation);
  if (is_due(clock.time, outcome.dt, config_.output.kymogram_interval)) record_kymograms(simulation);
  if (fields_ && is_due(clock.time, outcome.dt, config_.output.fields_interval)) write_fields(simulation);
}

void RunOutput::record_kymograms(Simulation& simulation) {
  for (std::size_t i = 0; i < kymograms_.size(); ++i) {
    const Glottis& glottis = *simulation.monitors()->glottises()[i];
    std::vector<double> row = {static_cast<double>(simulation.clock().step), simulation.clock().time};
    const double length = scene_.parent.dimension == 3 ? glottis.grid.span.end - glottis.grid.span.begin : 1;
    for (const double area : simulation.monitors()->opening(glottis).areas) row.push_back(area / length);
    kymograms_[i]->write(row);
  }
}

void RunOutput::record_flow(Simulation& simulation) {
  flow_record_->write(
      recorded(record_layout_, simulation.history()->snapshots().back(), scene_.flow->mesh, vertex_is_wet_));
}

void RunOutput::record_microphones(Simulation& simulation) {
  if (surface_microphones_) write_surface_series(*simulation.surface_microphones(), *surface_microphones_);
  for (std::size_t i = 0; i < microphones_.size(); ++i) {
    const auto block = simulation.voices()[i]->microphones().collect();
    const std::size_t count = config_.microphones.size();
    for (std::size_t sample = 0; sample < block.times.size(); ++sample) {
      std::vector<double> row = {block.times[sample]};
      if (simulation.source()) row.push_back(simulation.source()->value(block.times[sample]));
      for (std::size_t i = sample * count; i < (sample + 1) * count; ++i) {
        if (block.flow.empty()) {
          row.push_back(block.values[i]);
        } else {
          row.insert(row.end(), {block.values[i] + block.flow[i], block.values[i], block.flow[i]});
        }
      }
      microphones_[i]->write(row);
    }
  }
}

void RunOutput::write_fields(Simulation& simulation) {
  constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
  std::vector<fem::Field> fields;
  std::vector<std::string> names;
  const auto add = [&](const std::string& name, const transfer::SharedVertices& way, const fem::Field& values) {
    way.carry(values, fields.emplace_back(parent_space_, values.components), undefined);
    names.push_back(name);
  };
  const auto add_flow = [&](const std::string& name, int components, std::vector<double> values) {
    fem::Field field(flow_space_, components);
    field.values = std::move(values);
    add(name, *flow_to_parent_, field);
  };
  if (simulation.history()) {
    const FlowSnapshot& flow = simulation.history()->snapshots().back();
    std::vector<double> pressure = flow.pressure;
    for (std::size_t v = 0; v < vertex_is_wet_.size(); ++v) {
      if (!vertex_is_wet_[v]) pressure[v] = undefined;
    }
    add_flow("velocity", scene_.parent.dimension, flow.velocity);
    add_flow("displacement", scene_.parent.dimension, flow.displacement);
    add_flow("pressure", 1, std::move(pressure));
    if (simulation.history()->can_close()) {
      const auto marks =
          mesh::mark_vertices_of_cells(scene_.flow->mesh, {flow.in_contact.begin(), flow.in_contact.end()});
      add_flow("contact", 1, {marks.begin(), marks.end()});
    }
  }
  for (std::size_t i = 0; i < simulation.voices().size(); ++i) {
    const Voice& voice = *simulation.voices()[i];
    voice.carry_to_parent(voice.pressure(), fields.emplace_back(parent_space_, 1), undefined);
    names.push_back(i == 0 ? "acoustic_pressure" : "acoustic_pressure_" + config_.acoustics[i].name);
  }
  std::vector<io::NamedValues> values;
  for (std::size_t i = 0; i < fields.size(); ++i) values.push_back({names[i], fields[i].components, fields[i].values});
  fields_->write(simulation.clock().step, simulation.clock().time, values);
}

void RunOutput::flush(Simulation& simulation) {
  record_microphones(simulation);
  history_->flush();
  for (auto& series : microphones_) series->flush();
  for (auto& series : kymograms_) series->flush();
  if (surface_microphones_) surface_microphones_->flush();
  if (flow_record_) flow_record_->flush();
}

}  // namespace vocalis::coupling
