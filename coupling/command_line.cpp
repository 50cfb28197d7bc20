#include "coupling/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <string_view>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"

namespace vocalis::coupling {

Arguments::Arguments(int argc, char** argv) {
  int split = 1;
  while (split < argc && std::string_view(argv[split]) != "--") ++split;
  for (int i = 1; i < split; ++i) ours.emplace_back(argv[i]);
  petsc.push_back(argv[0]);
  for (int i = split + 1; i < argc; ++i) petsc.push_back(argv[i]);
  petsc_count = static_cast<int>(petsc.size());
  petsc.push_back(nullptr);
  petsc_values = petsc.data();
}

namespace {

std::string as_toml_text(const std::string& text) {
  base::TomlNode node;
  node.kind = base::TomlNode::Kind::text;
  node.text = text;
  return base::toml_value(node);
}

/// A number of steps. Empty: it is one.
std::string step_count_mistake(const std::string& text) {
  long count = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), count);
  const bool is_whole = read.ec == std::errc() && read.ptr == text.data() + text.size();
  return is_whole && count > 0 ? "" : "a whole number of at least 1 is needed, not " + text;
}

/// Throws UserError where the first word is no command.
void require_known_command(const std::vector<std::string>& arguments, const CLI::App& app) {
  if (arguments.empty() || arguments[0].starts_with("-")) return;
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
  if (std::find(names.begin(), names.end(), arguments[0]) != names.end()) return;
  throw base::UserError("there is no such command", "\"" + arguments[0] + "\"",
                        base::did_you_mean(arguments[0], names));
}

}  // namespace

Command parse_command(const std::vector<std::string>& arguments) {
  Command command;
  std::string out;
  CLI::App app("Vocalis " VOCALIS_VERSION ": computes a voice from a case file.", "vocalis");
  app.require_subcommand(1);
  app.footer("What follows -- is for PETSc, for example -- -log_view");

  const auto add = [&](const char* name, const char* words, const char* target, const char* target_words) {
    CLI::App* sub = app.add_subcommand(name, words);
    sub->add_option(target, command.target, target_words)->required();
    return sub;
  };
  CLI::App* run = add("run", "compute a case into a run folder", "CASE", "case file, *.toml");
  CLI::App* check = add("check", "read and check a case; nothing is solved", "CASE", "case file, *.toml");
  CLI::App* resume = add("resume", "go on from the last checkpoint", "RUN", "run folder");
  CLI::App* replay = add("replay", "sound alone, on the flow that a run recorded", "RUN", "run folder");
  CLI::App* spectrum = add("spectrum", "spectra, f0 and formants of a run", "RUN", "run folder");
  for (CLI::App* sub : {run, check, replay}) {
    sub->add_option("--set", command.overrides, "KEY=VALUE: change one value of the case; may stand several times")
        ->allow_extra_args(false);
    sub->add_option("--out", out, "run folder (output.directory of the case, or RUN-replay, otherwise)");
  }
  for (CLI::App* sub : {run, resume, replay}) {
    sub->add_option("--steps", command.steps, "stop after so many steps; resume goes on")->check(step_count_mistake);
  }

  require_known_command(arguments, app);
  try {
    std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // CLI11 takes them from the back
    app.parse(reversed);
  } catch (const CLI::CallForHelp&) {
    for (const CLI::App* sub : app.get_subcommands()) command.text = sub->help();
    if (command.text.empty()) command.text = app.help();
    return command;
  } catch (const CLI::ParseError& error) {
    std::string found;
    for (const std::string& argument : arguments) found += (found.empty() ? "" : " ") + argument;
    throw base::UserError(std::string("the command cannot be understood: ") + error.what(),
                          found.empty() ? "nothing" : found,
                          "write run CASE [--out DIR] [--set KEY=VALUE]..., check CASE, resume RUN, "
                          "replay RUN [--out DIR] [--set KEY=VALUE]..., spectrum RUN, or --help");
  }
  if (run->parsed()) command.kind = Command::Kind::run;
  if (check->parsed()) command.kind = Command::Kind::check;
  if (resume->parsed()) command.kind = Command::Kind::resume;
  if (replay->parsed()) command.kind = Command::Kind::replay;
  if (spectrum->parsed()) command.kind = Command::Kind::spectrum;
  if (!out.empty()) command.overrides.push_back("output.directory=" + as_toml_text(out));
  return command;
}

}  // namespace vocalis::coupling
