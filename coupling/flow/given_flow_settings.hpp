#pragma once

#include <string>
#include <variant>

#include "coupling/flow/duct_piston.hpp"
#include "coupling/flow/uniform_flow.hpp"
#include "coupling/flow/vortex_pair.hpp"

namespace vocalis::coupling {

using FlowFormula = std::variant<UniformFlow, DuctPiston, VortexPair>;

/// A flow in a file, see docs/flow-record.md.
struct FlowRecord {
  std::string file;  ///< absolute path
  std::string run;   ///< absolute path of the run folder whose monitors watched it; empty: none is known
};

/// A flow that is not solved.
using GivenFlowSettings = std::variant<FlowFormula, FlowRecord>;

}  // namespace vocalis::coupling
