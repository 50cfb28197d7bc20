#include "coupling/run_output.hpp"

#include <cmath>
#include <filesystem>
#include <limits>

#include "core/mesh/facets.hpp"
#include "coupling/far_field/surface_series.hpp"
#include "coupling/figures.hpp"
#include "coupling/flow/recorded_flow.hpp"
#include "coupling/series_headers.hpp"

namespace vocalis::coupling {

namespace {

/// Whether a multiple of the interval [s] lies in the step that ended now.
bool is_due(double time, double dt, double interval) {
  return interval > 0 && std::floor((time + 1e-9 * dt) / interval) > std::floor((time - dt + 1e-9 * dt) / interval);
}

std::unique_ptr<io::SeriesWriter> open_series(MPI_Comm comm, const std::string& path,
                                              const io::SeriesWriter::Header& header,
                                              const std::vector<std::string>& columns, int column, double last,
                                              bool goes_on) {
  if (goes_on) return std::make_unique<io::SeriesWriter>(io::SeriesWriter::resume(comm, path, columns, column, last));
  return std::make_unique<io::SeriesWriter>(comm, path, header, columns);
}

}  // namespace

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
