#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/monitors/glottis.hpp"
#include "coupling/monitors/monitor_settings.hpp"
#include "coupling/monitors/probe.hpp"
#include "fsi_solver/fsi_solver.hpp"
#include "fsi_solver/measures/body.hpp"
#include "fsi_solver/measures/energy.hpp"
#include "fsi_solver/measures/energy_balance.hpp"

namespace vocalis::coupling {

/// Monitors bound to the flow that they watch.
class Monitors {
 public:
  /// The solver must outlive the monitors. Throws UserError for a group that the flow mesh does not have or no fluid
  /// touches, a point outside the mesh, a line in space, and columns of the same name. Collective.
  Monitors(const fsi::FsiSolver& flow, const std::vector<MonitorSettings>& settings);

  /// Column names with units, "gap_m", "flow_m2_s", "tip_x_m".
  const std::vector<std::string>& columns() const { return columns_; }
  /// To be called after every accepted step, in order: keeps account of the energy. Collective.
  void follow_step();
  /// One value a column, the same on every rank: of the accepted state; forces, energies and powers of the last step's
  /// stage. Collective.
  std::vector<double> evaluate() const;

  /// The monitors of kind glottis, in order.
  std::vector<const Glottis*> glottises() const;
  /// The opening along one of them, of the accepted state. Collective.
  GlottalOpening opening(const Glottis& glottis) const;

  /// What monitors remember from step to step, for checkpoints.
  const fsi::EnergyBalance& balance() const { return balance_; }
  void set_balance(const fsi::EnergyBalance& balance) { balance_ = balance; }

 private:
  struct Bound {
    MonitorSettings settings;
    std::vector<mesh::NamedFacet> facets;  ///< of gap and flux
    Probe probe, other;                    ///< of displacement and pressures
    std::optional<fsi::Body> body;         ///< of force
    std::optional<Glottis> glottis;
  };
  Bound bind(const MonitorSettings& monitor) const;
  void find_facets(Bound& bound) const;
  Probe find(const MonitorSettings& monitor, const fem::Point& position, bool in_fluid) const;
  std::vector<double> force(const Bound& monitor) const;

  const fsi::FsiSolver* flow_;
  std::vector<std::int32_t> cell_is_fluid_;  ///< of local cells, ghosts too
  std::optional<fsi::OpenFacets> open_;      ///< only where an energy is watched, and so are ...
  fsi::EnergyRates rates_;
  fsi::EnergyBalance balance_;
  std::vector<Bound> monitors_;
  std::vector<std::string> columns_;
};

}  // namespace vocalis::coupling
