#include "coupling/flow/given_flow.hpp"

#include "coupling/flow/formula_flow.hpp"
#include "coupling/flow/recorded_flow.hpp"

namespace vocalis::coupling {

std::unique_ptr<GivenFlow> make_given_flow(const GivenFlowSettings& settings, const Scene& scene) {
  if (const auto* record = std::get_if<FlowRecord>(&settings)) {
    return std::make_unique<RecordedFlow>(record->file, scene);
  }
  return std::make_unique<FormulaFlow>(std::get<FlowFormula>(settings), scene);
}

}  // namespace vocalis::coupling
