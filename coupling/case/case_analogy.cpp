#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "coupling/analogies/analogy.hpp"
#include "coupling/case/case_sections.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;
using Derivative = acoustic::PressureDerivative;

/// The flow that carries sound, of analogies in which one does.
void read_carrying_flow(base::Table& table, const Case& config, acoustic::AnalogySettings& analogy) {
  const bool may_be_present = analogy.name == "pcwe";
  if (!may_be_present && analogy.name != "ape") return;
  analogy.convection = table.boolean_or("convection", analogy.convection);
  analogy.mean_flow = !may_be_present || table.boolean_or("mean_flow", analogy.mean_flow);
  if (analogy.mean_flow) {
    analogy.mean_time = table.number_or("mean_time", config.time.end / 10, base::positive, "s");
  }
}

void read_window(base::Table& table, acoustic::AnalogySettings& analogy) {
  auto window = table.table_if("window");
  if (!window) return;
  const std::vector<double> centre = window->numbers("centre", 2, 3, "m");
  std::copy(centre.begin(), centre.end(), analogy.window_centre.begin());
  analogy.window_radius = window->number("radius", base::positive, "m");
  analogy.window_width = window->number_or("width", analogy.window_width, base::not_negative, "m");
}

acoustic::AnalogySettings read_analogy(base::Table& table, const std::string& name, const Case& config) {
  acoustic::AnalogySettings analogy;
  analogy.name = name;
  if (analogy.name == "none") return analogy;
  analogy.fade_in = table.number_or("source_fade_in", analogy.fade_in, base::not_negative, "s");
  read_window(table, analogy);
  if (analogy.name == "pressure_rate" || analogy.name == "pcwe") {
    analogy.pressure_derivative = table.choice_or<Derivative>(
        "pressure_derivative", analogy.pressure_derivative,
        {{"step", Derivative::step}, {"bdf2", Derivative::bdf2}, {"five_point", Derivative::five_point}});
  }
  read_carrying_flow(table, config, analogy);
  return analogy;
}

/// One name, or several.
std::vector<std::string> read_names(base::Table& table, const Case& config) {
  if (!table.is_array("analogy")) {
    return {table.text_or("analogy", config.has_flow() ? acoustic::AnalogySettings().name : "none", analogy_names())};
  }
  std::vector<std::string> names = table.texts("analogy");
  for (const std::string& name : names) {
    const std::vector<std::string> known = analogy_names();
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw UserError(table.place("analogy") + " must be some of " + base::list_of(known), "\"" + name + "\"",
                    base::did_you_mean(name, known));
  }
  return names;
}

}  // namespace

std::vector<acoustic::AnalogySettings> read_analogies(base::Table& table, const Case& config) {
  std::vector<acoustic::AnalogySettings> analogies;
  for (const std::string& name : read_names(table, config)) {
    if (!config.has_flow() && name != "none") {
      throw UserError(table.place("analogy") + " needs a flow to take the sound from",
                      "\"" + name + "\" without [flow]", "write analogy = \"none\" beside [source]");
    }
    analogies.push_back(read_analogy(table, name, config));
  }
  return analogies;
}

}  // namespace vocalis::coupling
