#pragma once

#include <array>
#include <string>
#include <vector>

namespace vocalis::coupling {

enum class MonitorKind {
  gap,                  ///< smallest distance of a group from the plane where a coordinate has a given value [m]
  glottis,              ///< the opening between folds, the air that passes it, contact; see columns_of
  flux,                 ///< volume flow through a group or across a line, ∫ v·n ds [m^2/s in 2-D, m^3/s]
  displacement,         ///< of the material or the mesh at a point, one column a component [m]
  force,                ///< of the fluid on groups, one column a component [N; in 2-D N per metre of depth]
  pressure,             ///< of the fluid at a point [Pa]
  pressure_difference,  ///< between two points [Pa]
  energy                ///< of the whole, its supply and loss, and what their balance leaves [J, W; in 2-D per metre]
};

/// A number of the flow that history.csv records at every step. Points are of the reference configuration: they move
/// with the material and the mesh. A line stands still.
struct MonitorSettings {
  std::string name;  ///< begins the names of the columns; may be empty for a force
  MonitorKind kind = MonitorKind::gap;
  std::string group;                ///< of facets, for gap, glottis and flux; empty for a flux across a line
  std::string other_group;          ///< of facets, for glottis: the surface of the other fold; empty: the plane instead
  std::vector<std::string> groups;  ///< of facets, for force
  int axis = 1;                     ///< 0, 1, 2 = x, y, z: normal of the plane, for gap and glottis
  double plane = 0;                 ///< its coordinate [m], for gap and glottis
  int along = 0;                    ///< axis of the flow, for glottis
  int stations = 200;               ///< places along the flow where the opening is measured, for glottis
  int span_stations = 50;           ///< the same along the third axis, in space
  double depth = 0;       ///< [m] length of the folds, for a glottis in the plane; 0: areas and flows stay per metre
  bool mirrored = false;  ///< half model: gap, glottis and flux count twice
  std::array<double, 3> position = {0, 0, 0};  ///< [m], for displacement and pressures
  std::array<double, 3> other = {0, 0, 0};     ///< [m] where the pressure is that is taken away, for its difference
  std::array<double, 3> from = {0, 0, 0};      ///< [m] a line's beginning, for flux in 2-D; what crosses it ...
  std::array<double, 3> to = {0, 0, 0};        ///< [m] ... to the right of the way to its end counts
  double reference_force = 0;                  ///< [N] that makes a force a coefficient; 0: the force itself
};

/// A column of history.csv: "tip_x_m" is the stem "tip_x" and the unit "_m". A coefficient has no unit.
struct MonitorColumn {
  std::string stem;
  std::string unit;
  std::string name() const { return stem + unit; }
};

/// The columns of a monitor, in order. Those of a glottis: its smallest gap, its smallest area (in the plane only with
/// a depth), in the plane the flow past the folds there, the largest speed of the fluid, the largest
/// pressure between the folds where they touch, the number of contact cells.
std::vector<MonitorColumn> columns_of(const MonitorSettings& monitor, int dimension);

}  // namespace vocalis::coupling
