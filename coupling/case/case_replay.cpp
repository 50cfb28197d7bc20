#include <filesystem>
#include <sstream>

#include "core/base/case_override.hpp"
#include "core/base/error.hpp"
#include "core/base/file_text.hpp"
#include "core/base/first_rank.hpp"
#include "coupling/case/case.hpp"
#include "coupling/case/case_sections.hpp"

namespace vocalis::coupling {

namespace {

using base::TomlNode;
using base::UserError;

/// A resolved case without the values that were chosen for it: what is changed now may have others.
std::string without_defaults(const std::string& resolved) {
  std::istringstream lines(resolved);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t comment = line.rfind('#');
    const bool is_default = comment != std::string::npos && comment > 0 && line.ends_with("default");
    if (!is_default) kept += line + "\n";
  }
  return kept;
}

void remove(TomlNode& table, std::string_view key) {
  table.children.remove_if([&](const TomlNode& child) { return child.key == key; });
}

void set_text(TomlNode& table, const std::string& key, const std::string& text) {
  remove(table, key);
  TomlNode node;
  node.kind = TomlNode::Kind::text;
  node.key = key;
  node.place = table.place;
  node.text = text;
  table.children.push_back(node);
}

/// The flow of the run becomes a record, unless it was given already; what belongs to a flow that is solved goes.
void replace_flow(MPI_Comm comm, TomlNode& root, const std::string& run) {
  TomlNode* flow = root.find("flow");
  if (!flow) {
    throw UserError("a replay needs the run folder of a case with a flow", run + " has none",
                    "run its case instead: sound alone is what it is");
  }
  remove(root, "record");
  if (flow->find("analytic") || flow->find("record")) return;
  const std::string record = (std::filesystem::path(run) / "flow_record.h5").string();
  base::on_first_rank(comm, [&] {
    if (std::filesystem::exists(record)) return;
    throw UserError("a replay needs a run whose flow was recorded", "no " + record,
                    "add a [record] table to its case, and run that again");
  });
  flow->children.remove_if([](const TomlNode& child) { return child.key != "density" && child.key != "viscosity"; });
  set_text(*flow, "record", record);
  set_text(*flow, "run", run);
  for (const char* key : {"contact", "monitor", "statistics"}) remove(root, key);
  if (TomlNode* time = root.find("time")) {
    time->children.remove_if([](const TomlNode& child) { return child.key != "end" && child.key != "dt"; });
  }
}

void check_override(const std::string& assignment) {
  for (const char* table : {"acoustic", "microphone", "output", "case", "expected"}) {
    const std::string name = table;
    if (assignment.starts_with(name + ".") || assignment.starts_with(name + "=")) return;
  }
  throw UserError("a replay can change the sound: acoustic, microphone, output", "--set " + assignment,
                  "run the case again for another mesh, flow or time");
}

}  // namespace

Case read_replay(MPI_Comm comm, const std::string& run, const std::vector<std::string>& overrides) {
  std::filesystem::path path = std::filesystem::absolute(run).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  const std::string folder = path.string();
  const std::string file = (path / "resolved.toml").string();
  TomlNode tree =
      base::parse_toml(without_defaults(base::read_text(comm, file, "resolved case of a run folder")), file);
  replace_flow(comm, tree, folder);
  if (!tree.find("output")) tree.children.emplace_back().key = "output";
  set_text(*tree.find("output"), "directory", folder + "-replay");
  for (const std::string& assignment : overrides) {
    check_override(assignment);
    base::apply_override(tree, assignment);
  }
  return read_case_tree(comm, file, std::move(tree));
}

}  // namespace vocalis::coupling
