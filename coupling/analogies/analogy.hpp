#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/fem/field.hpp"
#include "coupling/analogies/flow_view.hpp"

namespace vocalis::coupling {

/// The right-hand side of the acoustic mass equation, (Q, q) + <g, q>, at the beginning and the end of a flow step;
/// between them it is linear. Loads on the flow mesh, as each rank has summed them over its own cells [m^2/s, m^3/s].
struct AnalogySource {
  fem::Load begin, end;
};

/// How an incompressible flow makes sound. One file each; `make_analogy` knows them by name.
class Analogy {
 public:
  virtual ~Analogy() = default;
  /// The source of one accepted flow step.
  virtual AnalogySource source(const FlowView& flow) const = 0;
};

/// density, speed_of_sound  of the air at rest, ρ [kg/m^3], c [m/s]. Throws UserError for an unknown name.
std::unique_ptr<Analogy> make_analogy(const std::string& name, double density, double speed_of_sound);

/// The names that `make_analogy` knows.
std::vector<std::string> analogy_names();

}  // namespace vocalis::coupling
