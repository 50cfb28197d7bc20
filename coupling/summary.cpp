#include "coupling/summary.hpp"

#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/error.hpp"

namespace vocalis::coupling {

namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json expected_figures(const Case& config, const Figures& figures) {
  Json result = Json::object();
  for (const auto& [name, expected] : config.expected) {
    Json entry = {{"value", expected.value}, {"tolerance", expected.tolerance}, {"source", expected.source}};
    if (expected.spread > 0) entry["spread"] = expected.spread;
    const auto found = figures.values.find(name);
    entry["error"] = found == figures.values.end() ? Json(nullptr) : number(found->second - expected.value);
    result[name] = entry;
  }
  return result;
}

/// A step's traffic.
Json traffic(const base::Traffic& of_all_steps, long steps) {
  const auto of_step = [&](std::int64_t count) { return static_cast<double>(count) / static_cast<double>(steps); };
  return {{"messages", of_step(of_all_steps.messages)},
          {"bytes", of_step(of_all_steps.bytes)},
          {"reductions", of_step(of_all_steps.reductions)},
          {"reduction_bytes", of_step(of_all_steps.reduction_bytes)}};
}

/// By phase, and of the whole step; empty before the first step.
Json communication(const RunFacts& facts) {
  Json result = Json::object();
  if (facts.counted_steps == 0) return result;
  for (const auto& phase : facts.phases) result[phase.name] = traffic(phase.traffic, facts.counted_steps);
  result["step"] = traffic(facts.traffic, facts.counted_steps);
  return result;
}

std::string expectation(const Case& config, const std::string& name, double value) {
  const auto expected = config.expected.find(name);
  if (expected == config.expected.end()) return "";
  const bool met = std::abs(value - expected->second.value) <= expected->second.tolerance;
  return fmt::format("   expected {:.6g} +- {:.3g}: {}", expected->second.value, expected->second.tolerance,
                     met ? "met" : "NOT MET");
}

}  // namespace

void write_summary(const std::string& path, const Case& config, const RunFacts& facts, const Figures& figures) {
  Json phases = Json::object(), results = Json::object();
  for (const auto& phase : facts.phases) phases[phase.name] = phase.seconds;
  for (const auto& [name, value] : figures.values) results[name] = number(value);
  const Json summary = {{"case", config.name},
                        {"version", VOCALIS_VERSION},
                        {"status", facts.status},
                        {"reason", facts.reason},
                        {"ranks", facts.ranks},
                        {"dimension", facts.dimension},
                        {"steps", facts.steps},
                        {"rejected_steps", facts.rejected_steps},
                        {"simulated_seconds", facts.simulated_seconds},
                        {"wall_seconds", facts.wall_seconds},
                        {"cells", facts.cells},
                        {"unknowns", facts.unknowns},
                        {"imbalance", facts.imbalance},
                        {"phases", phases},
                        {"communication", communication(facts)},
                        {"contact", facts.contact},
                        {"peak_memory_bytes", facts.peak_memory_bytes},
                        {"vibration", figures.vibration},
                        {"results", results},
                        {"expected", expected_figures(config, figures)}};
  std::ofstream file(path);
  file << summary.dump(2) << '\n';
  file.close();
  if (!file) throw base::UserError("the run folder must be writable", path, "check the folder's rights and free space");
}

void print_table(base::Log& log, const Case& config, const RunFacts& facts, const Figures& figures) {
  log.info("");
  log.info("{} after {} steps, {:.6g} s simulated in {}", facts.status, facts.steps, facts.simulated_seconds,
           base::duration_words(facts.wall_seconds));
  if (!facts.reason.empty()) log.info("  {}", facts.reason);
  for (const auto& [name, value] : figures.values) {
    log.info("  {:<28} {:>12.6g}{}", name, value, expectation(config, name, value));
  }
  for (const auto& [name, expected] : config.expected) {
    if (figures.values.contains(name)) continue;
    log.info("  {:<28} {:>12}   expected {:.6g} +- {:.3g}: NOT MET", name, "not found", expected.value,
             expected.tolerance);
  }
  if (!figures.vibration.empty()) log.info("  {:<28} {:>12}", "the folds' vibration", figures.vibration);
  log.info("  wall seconds by phase");
  for (const auto& phase : facts.phases) log.info("    {:<26} {:>12.2f}", phase.name, phase.seconds);
}

double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace vocalis::coupling
