#include "coupling/run_folder.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "coupling/figures.hpp"

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
    if (channel.solver == config.acoustics[solver].name) columns.push_back(channel.column);
  }
  return columns;
}

Header microphone_header(const Case& config, std::size_t solver) {
  const acoustic::AcousticSettings& settings = config.acoustics[solver];
  Header header = {{"case", config.name},
                   {"pressure", "acoustic pressure p_a [Pa]; the sum with the flow's pressure is the whole"},
                   {"analogy", settings.analogy},
                   {"sign", "source -(1 / (rho c^2)) dp/dt: p_a adds to the flow's pressure"},
                   {"speed_of_sound_m_s", fmt::format("{}", settings.speed_of_sound)},
                   {"density_kg_m3", fmt::format("{}", settings.density)}};
  for (const auto& microphone : config.microphones) {
    header.emplace_back("position_m." + microphone.name, fmt::format("{} {} {}", microphone.position[0],
                                                                     microphone.position[1], microphone.position[2]));
  }
  return header;
}

std::unique_ptr<io::SeriesWriter> open_series(MPI_Comm comm, const std::string& path, const Header& header,
                                              const std::vector<std::string>& columns, int column, double last,
                                              bool goes_on) {
  if (goes_on) return std::make_unique<io::SeriesWriter>(io::SeriesWriter::resume(comm, path, columns, column, last));
  return std::make_unique<io::SeriesWriter>(comm, path, header, columns);
}

/// Whether a run writes files of this name.
bool is_of_a_run(const std::string& name) {
  for (const char* known :
       {"checkpoint.h5", "summary.json", "report.html", "spectra.csv", "fields.h5", "fields.xdmf"}) {
    if (name == known) return true;
  }
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
  if (!config.microphones.empty()) {
    for (std::size_t i = 0; i < config.acoustics.size(); ++i) {
      microphones_.push_back(open_series(comm, path / microphones_file(config, i), microphone_header(config, i),
                                         microphone_columns(config, i), 0, clock.time * (1 + 1e-12), goes_on));
    }
  }
  if (config.output.fields_interval > 0) {
    parent_space_ = fem::lagrange(scene.parent, 1);
    if (scene.flow) {
      flow_to_parent_.emplace(transfer::SharedVertices::to_parent(scene.parent, *scene.flow));
      vertex_is_wet_ = mesh::mark_vertices_of_cells(scene.flow->mesh, fluid_cells(scene));
    }
    if (scene.acoustic) acoustic_to_parent_.emplace(transfer::SharedVertices::to_parent(scene.parent, *scene.acoustic));
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
  if (!fields_) return;
  const double interval = config_.output.fields_interval;
  const bool due = std::floor((clock.time + 1e-9 * outcome.dt) / interval) >
                   std::floor((clock.time - outcome.dt + 1e-9 * outcome.dt) / interval);
  if (due) write_fields(simulation);
}

void RunOutput::record_microphones(Simulation& simulation) {
  for (std::size_t i = 0; i < microphones_.size(); ++i) {
    const auto block = simulation.voices()[i]->microphones().collect();
    const std::size_t count = config_.microphones.size();
    for (std::size_t sample = 0; sample < block.times.size(); ++sample) {
      std::vector<double> row = {block.times[sample]};
      if (simulation.source()) row.push_back(simulation.source()->value(block.times[sample]));
      row.insert(row.end(), block.values.begin() + sample * count, block.values.begin() + (sample + 1) * count);
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
  if (const fsi::FsiSolver* flow = simulation.flow()) {
    fem::Field pressure = flow->fluid_pressure();
    for (std::size_t v = 0; v < vertex_is_wet_.size(); ++v) {
      if (!vertex_is_wet_[v]) pressure.values[v] = undefined;
    }
    add("velocity", *flow_to_parent_, flow->velocity_at_vertices());
    add("displacement", *flow_to_parent_, flow->displacement_at_vertices());
    add("pressure", *flow_to_parent_, pressure);
  }
  for (std::size_t i = 0; i < simulation.voices().size(); ++i) {
    add(i == 0 ? "acoustic_pressure" : "acoustic_pressure_" + config_.acoustics[i].name, *acoustic_to_parent_,
        simulation.voices()[i]->solver().pressure());
  }
  std::vector<io::NamedValues> values;
  for (std::size_t i = 0; i < fields.size(); ++i) values.push_back({names[i], fields[i].components, fields[i].values});
  fields_->write(simulation.clock().step, simulation.clock().time, values);
}

void RunOutput::flush(Simulation& simulation) {
  record_microphones(simulation);
  history_->flush();
  for (auto& series : microphones_) series->flush();
}

}  // namespace vocalis::coupling
