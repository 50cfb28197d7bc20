#include "coupling/case/case.hpp"

#include <algorithm>
#include <fstream>

#include "core/base/case_override.hpp"
#include "core/base/error.hpp"
#include "core/base/file_text.hpp"
#include "core/base/mpi.hpp"
#include "coupling/case/case_sections.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;

void read_output(base::Table& root, Case& config) {
  base::Table output = root.table_or_empty("output");
  OutputSettings& settings = config.output;
  settings.directory = output.text_or("directory", "runs/" + config.name);
  settings.fields_interval = output.number_or("fields_interval", settings.fields_interval, base::not_negative, "s");
  settings.kymogram_interval =
      output.number_or("kymogram_interval", settings.kymogram_interval, base::not_negative, "s");
  settings.checkpoint_steps = output.integer_or("checkpoint_steps", settings.checkpoint_steps, base::not_negative);
}

void read_expected(base::Table& root, Case& config) {
  auto expected = root.table_if("expected");
  if (!expected) return;
  for (const std::string& name : expected->keys()) {
    base::Table result = expected->table(name);
    ExpectedResult& wanted = config.expected[name];
    wanted.value = result.number("value", base::any_number);
    wanted.tolerance = result.number("tolerance", base::positive);
    wanted.source = result.text("source");
    wanted.spread = result.number_or("spread", wanted.spread, base::not_negative);
  }
}

/// Rules over several sections.
void check_together(const base::Table& root, const Case& config) {
  const auto is_fluid = [](const Region& region) { return region.kind == RegionKind::fluid; };
  const bool has_fluid = std::any_of(config.regions.begin(), config.regions.end(), is_fluid);
  const auto is_solid = [](const Region& region) { return region.kind == RegionKind::solid; };
  const bool all_solid = std::all_of(config.regions.begin(), config.regions.end(), is_solid);
  if (config.has_flow() && !has_fluid && !(config.flow && all_solid)) {
    throw UserError(root.place("flow") + " needs a region of fluid", "no [[region]] of kind \"fluid\"",
                    "give one region kind = \"fluid\", or leave [flow] out");
  }
  if (!config.acoustics.empty() && all_solid) {
    throw UserError(root.place("acoustic") + " needs a region of fluid or air", "solid regions only",
                    "give one region kind = \"air\"");
  }
  if (config.has_flow() && config.source) {
    throw UserError(root.place("source") + " prescribes the sound's source, so there must be no [flow]", "both",
                    "leave out one of [flow] and [source]");
  }
  if (!config.has_flow() && !config.source) {
    throw UserError(config.file + ": something must move the air", "neither [flow] nor [source]",
                    "add [flow], or [source] for acoustics alone");
  }
  if (config.source && config.acoustics.empty()) {
    throw UserError(root.place("source") + " needs an acoustic solver", "no [[acoustic]]", "add an [[acoustic]] table");
  }
  if (!config.flow && !config.monitors.empty()) {
    throw UserError(root.place("monitor") + " watches a flow that is solved",
                    config.given_flow ? "a flow by a formula or a record" : "no [flow]", "leave the monitors out");
  }
  if (!config.microphones.empty() && config.acoustics.empty()) {
    throw UserError(
        root.place("microphone") + " needs an acoustic solver", "no [[acoustic]]",
        "add an [[acoustic]] table, or let them hear a surface of the flow with kind = \"curle\" or \"fwh\"");
  }
}

}  // namespace

bool Case::may_move() const {
  const bool moves_solids = flow || (given_flow && std::holds_alternative<FlowRecord>(*given_flow));
  return moves_solids && std::any_of(regions.begin(), regions.end(),
                                     [](const Region& region) { return region.kind == RegionKind::solid; });
}

Case read_case(MPI_Comm comm, const std::string& file, const std::vector<std::string>& overrides) {
  base::TomlNode tree = base::parse_toml(base::read_text(comm, file, "case file"), file);
  for (const std::string& assignment : overrides) base::apply_override(tree, assignment);
  return read_case_tree(comm, file, std::move(tree));
}

Case read_case_tree(MPI_Comm comm, const std::string& file, base::TomlNode tree) {
  Case config;
  config.file = file;
  base::Table root(tree);

  base::Table head = root.table("case");
  config.name = read_plain_name(head, "name");
  config.description = head.text_or("description", "");
  base::Table mesh = root.table("mesh");
  config.mesh = read_mesh(comm, mesh, config);
  read_regions(root, config);
  read_flow(root, config);
  read_given_flow(comm, root, config);
  read_time(root, config);
  read_contact(root, config);
  read_acoustics(comm, root, config);
  read_source(comm, root, config);
  read_microphones(root, config);
  read_monitors(root, config);
  read_statistics(root, config);
  read_output(root, config);
  read_record(root, config);
  read_expected(root, config);
  root.reject_unknown_keys();
  check_together(root, config);
  config.resolved = base::write_toml(tree);
  return config;
}

void write_resolved(MPI_Comm comm, const Case& config, const std::string& path) {
  int written = 1;
  if (base::rank(comm) == 0) {
    std::ofstream file(path);
    file << "# " << config.file << ", resolved by Vocalis " << VOCALIS_VERSION << ": all values, SI units.\n\n"
         << config.resolved;
    file.close();
    written = file ? 1 : 0;
  }
  MPI_Bcast(&written, 1, MPI_INT, 0, comm);
  if (!written) throw UserError(path + ": the resolved case cannot be written", path, "choose another --out folder");
}

}  // namespace vocalis::coupling
