#pragma once

#include <memory>
#include <string>
#include <vector>

#include "acoustic_solver/settings.hpp"
#include "core/fem/field.hpp"
#include "coupling/analogies/flow_view.hpp"

namespace vocalis::coupling {

/// The right-hand side of the wave equation at the beginning and the end of a flow step; between them it is linear.
/// Loads on the flow mesh, as each rank has summed them over its own cells. What they are: `Unknown`.
struct AnalogySource {
  fem::Load begin, end;
};

/// What the wave equation of an analogy is solved for, and so what drives it.
enum class Unknown {
  acoustic_pressure,  ///< p_a, driven by volume: (Q, q) + <g, q> [m^3/s; m^2/s in two dimensions]. p = p_ic + p_a
  pressure,  ///< p itself, driven by forces: (f, ∇q) / ρ - <∂t u·n, q> [m^3/s^2]. The solver gets this rate
             ///< of a source of volume and so runs for rates: its p is ∂t p, its ρψ is p
  enthalpy   ///< likewise p + `head`
};

/// What every analogy is made from.
struct AnalogyMedium {
  double density = 0;          ///< of the air at rest, ρ [kg/m^3]
  double speed_of_sound = 0;   ///< c [m/s]
  std::vector<double> window;  ///< (flow vertices) weight of the source, 0 to 1: of Q and the outlet's flux, or of u u
                               ///< before its divergence is taken; empty: 1
  double kinematic_viscosity = 0;  ///< of the flow, ν [m^2/s]
};

/// How an incompressible flow makes sound. One file each; `make_analogy` knows them by name.
class Analogy {
 public:
  virtual ~Analogy() = default;

  virtual Unknown unknown() const { return Unknown::acoustic_pressure; }

  /// Follows one accepted step of the flow: to be called once for each, in order, before anything else is asked.
  virtual void follow(const FlowView&) {}

  /// The source of that step.
  virtual AnalogySource source(const FlowView& flow) const = 0;

  /// The flow U [m/s] that carries sound in this step, (flow vertices, d); empty: none does.
  virtual std::vector<double> convection(const FlowView&) const { return {}; }

  /// With `Unknown::enthalpy`: what of it is no pressure, (flow vertices) [Pa], where the flow has this velocity;
  /// empty: nothing.
  virtual std::vector<double> head(const FlowView&, const std::vector<double>& velocity) const {
    static_cast<void>(velocity);
    return {};
  }

  /// What it remembers from step to step, for checkpoints.
  virtual std::vector<std::vector<double>*> memory() { return {}; }
};

/// Throws UserError for an unknown name.
std::unique_ptr<Analogy> make_analogy(const acoustic::AnalogySettings& settings, AnalogyMedium medium);

/// The names that `make_analogy` knows.
std::vector<std::string> analogy_names();

}  // namespace vocalis::coupling
