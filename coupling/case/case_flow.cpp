#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "coupling/case/case_sections.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;

const std::vector<std::pair<std::string, fsi::FlowBoundaryKind>> boundary_kinds = {
    {"velocity", fsi::FlowBoundaryKind::velocity},
    {"wall", fsi::FlowBoundaryKind::wall},
    {"symmetry", fsi::FlowBoundaryKind::symmetry},
    {"pressure", fsi::FlowBoundaryKind::pressure},
    {"total_pressure", fsi::FlowBoundaryKind::total_pressure},
    {"outlet", fsi::FlowBoundaryKind::outlet},
    {"fixed", fsi::FlowBoundaryKind::fixed}};

double read_poisson_ratio(base::Table& table, const fsi::SolidMaterial& material) {
  if (!material.incompressible) {
    const double ratio = table.number_or("poisson_ratio", material.poisson_ratio, base::between(-1, 0.5));
    if (ratio > -1 && ratio < 0.5) return ratio;
    throw UserError(table.place("poisson_ratio") + " of a compressible solid must be more than -1 and less than 0.5",
                    std::to_string(ratio), "write incompressible = true for 0.5, or a smaller ratio");
  }
  if (table.has("poisson_ratio") && table.number("poisson_ratio", base::any_number) != 0.5) {
    throw UserError(table.place("poisson_ratio") + " of an incompressible solid is 0.5", "another ratio",
                    "leave it out, or write incompressible = false");
  }
  return material.poisson_ratio;
}

fsi::SolidMaterial read_material(base::Table& table, const std::string& region) {
  fsi::SolidMaterial material;
  material.region = region;
  material.model =
      table.choice_or<fsi::SolidModel>("material", material.model,
                                       {{"neo_hookean", fsi::SolidModel::neo_hookean},
                                        {"saint_venant_kirchhoff", fsi::SolidModel::saint_venant_kirchhoff}});
  material.incompressible = table.boolean_or("incompressible", material.incompressible);
  material.density = table.number_or("density", material.density, base::positive, "kg/m^3");
  material.young_modulus = table.number("young_modulus", base::positive, "Pa");
  material.poisson_ratio = read_poisson_ratio(table, material);
  material.damping = table.number_or("damping", material.damping, base::not_negative, "Pa s");
  return material;
}

fsi::FlowBoundary read_boundary(base::Table& table, Case& config) {
  using Kind = fsi::FlowBoundaryKind;
  fsi::FlowBoundary boundary;
  boundary.group = read_group(table, config);
  boundary.kind = table.choice("kind", boundary_kinds);
  if (boundary.kind == Kind::pressure || boundary.kind == Kind::total_pressure)
    boundary.pressure = table.number("pressure", base::any_number, "Pa");
  if (boundary.kind == Kind::outlet) {
    boundary.pressure = table.number_or("pressure", boundary.pressure, base::any_number, "Pa");
  }
  if (boundary.kind == Kind::velocity) {
    boundary.velocity = read_vector(table, "velocity", "m/s", config);
    boundary.profile = table.choice_or<fsi::VelocityProfile>(
        "profile", boundary.profile,
        {{"uniform", fsi::VelocityProfile::uniform}, {"parabolic", fsi::VelocityProfile::parabolic}});
  }
  if (boundary.kind != Kind::wall && boundary.kind != Kind::symmetry && boundary.kind != Kind::fixed) {
    boundary.ramp = table.number_or("ramp", boundary.ramp, base::not_negative, "s");
    boundary.period = table.number_or("period", boundary.period, base::not_negative, "s");
  }
  return boundary;
}

/// What the finite elements are, and what holds them stable.
void read_discretisation(base::Table& table, fsi::FlowSettings& flow) {
  flow.elements = table.choice_or<fsi::Elements>("elements", flow.elements,
                                                 {{"P1P1", fsi::Elements::p1p1}, {"P2P1", fsi::Elements::p2p1}});
  flow.geometry = table.choice_or<fsi::Geometry>(
      "geometry", flow.geometry, {{"implicit", fsi::Geometry::implicit}, {"explicit", fsi::Geometry::explicit_}});
  flow.streamline_stabilisation = table.boolean_or("streamline_stabilisation", flow.streamline_stabilisation);
  if (flow.elements == fsi::Elements::p1p1) {
    flow.pressure_stabilisation = table.boolean_or("pressure_stabilisation", flow.pressure_stabilisation);
  } else if (table.has("pressure_stabilisation")) {
    throw UserError(table.place("pressure_stabilisation") + " is of elements = \"P1P1\" alone", "elements = \"P2P1\"",
                    "leave it out: P2P1 is stable by itself");
  }
}

/// How the fluid's mesh follows the solids, where there are both.
void read_smoother(base::Table& table, Case& config) {
  fsi::FlowSettings& flow = *config.flow;
  flow.mesh_stiffening = table.number_or("mesh_stiffening", flow.mesh_stiffening, base::not_negative);
  const auto is_fluid = [](const Region& region) { return region.kind == RegionKind::fluid; };
  const bool has_fluid = std::any_of(config.regions.begin(), config.regions.end(), is_fluid);
  if (has_fluid && !flow.solids.empty()) {
    flow.smoother = table.choice_or<fsi::Smoother>(
        "smoother", flow.smoother, {{"linear", fsi::Smoother::linear}, {"nonlinear", fsi::Smoother::nonlinear}});
    flow.smoother_quality = table.number_or("smoother_quality", flow.smoother_quality, base::between(0, 1));
    return;
  }
  for (const char* key : {"smoother", "smoother_quality"}) {
    if (!table.has(key)) continue;
    throw UserError(table.place(key) + " needs a solid that moves the mesh of a fluid",
                    has_fluid ? "no region of kind \"solid\"" : "no region of kind \"fluid\"", "leave it out");
  }
}

/// A step that adapts to its local error; without a tolerance it stays dt.
void read_adaptive_step(base::Table& table, fsi::TimeSettings& time) {
  time.tolerance = table.number_or("tolerance", time.tolerance, base::between(0, 1));
  time.largest_step = table.number_or("largest_dt", time.largest_step, base::not_negative, "s");
  if (time.largest_step > 0 && time.largest_step < time.step) {
    throw UserError(table.place("largest_dt") + " must not be smaller than time.dt [s]",
                    std::to_string(time.largest_step), "choose a larger one, or leave it out: then it is dt");
  }
}

}  // namespace

void read_regions(base::Table& root, Case& config) {
  const bool is_solved = root.has("flow") && !is_flow_given(root);
  if (is_solved) config.flow.emplace();
  std::vector<std::string> names;
  for (base::Table& table : root.tables("region")) {
    Region region;
    region.name = table.text("name");
    region.kind = table.choice<RegionKind>(
        "kind", {{"fluid", RegionKind::fluid}, {"solid", RegionKind::solid}, {"air", RegionKind::air}});
    // Where no flow is solved a solid is only a hole in the air; its material may stand in the file.
    const bool has_material = is_solved || table.has("young_modulus");
    if (region.kind == RegionKind::solid && has_material) {
      const fsi::SolidMaterial material = read_material(table, region.name);
      if (is_solved) config.flow->solids.push_back(material);
    }
    config.references.push_back({MeshReference::Kind::region, table.place("name"), region.name, {}});
    config.regions.push_back(region);
    names.push_back(region.name);
  }
  if (config.regions.empty()) {
    throw UserError(config.file + ": a case needs at least one region", "no [[region]]",
                    "add [[region]] with name = \"...\" and kind = \"fluid\" for each group of cells of the mesh");
  }
  reject_duplicates(root, "[[region]]", names);
}

void read_flow(base::Table& root, Case& config) {
  if (!config.flow) return;
  base::Table table = root.table("flow");
  fsi::FlowSettings& flow = *config.flow;
  flow.density = table.number_or("density", flow.density, base::positive, "kg/m^3");
  flow.viscosity = table.number_or("viscosity", flow.viscosity, base::positive, "Pa s");
  config.fluid = {flow.density, flow.viscosity};
  flow.gravity = read_vector_or(table, "gravity", flow.gravity, "m/s^2", config);
  read_discretisation(table, flow);
  flow.newton_tolerance = table.number_or("newton_tolerance", flow.newton_tolerance, base::inside(0, 1));
  flow.newton_iterations = table.integer_or("newton_iterations", flow.newton_iterations, base::between(1, 1000));
  flow.backflow_stabilisation =
      table.number_or("backflow_stabilisation", flow.backflow_stabilisation, base::between(0, 1));
  read_smoother(table, config);
  std::vector<std::string> groups;
  for (base::Table& boundary : table.tables("boundary")) {
    flow.boundaries.push_back(read_boundary(boundary, config));
    groups.push_back(flow.boundaries.back().group);
  }
  reject_duplicates(root, "[[flow.boundary]]", groups, "group");
}

void read_time(base::Table& root, Case& config) {
  base::Table table = root.table("time");
  fsi::TimeSettings& time = config.time;
  time.end = table.number("end", base::positive, "s");
  if (!config.has_flow() && !table.has("dt")) return;  // acoustics alone: the step of the sound is enough
  time.step = table.number("dt", base::positive, "s");
  if (time.step > time.end) {
    throw UserError(table.place("dt") + " must not be larger than time.end [s]", std::to_string(time.step),
                    "choose a smaller step, or a later end");
  }
  if (!config.flow) return;
  time.scheme = table.choice_or<fsi::TimeScheme>("scheme", time.scheme,
                                                 {{"theta", fsi::TimeScheme::theta}, {"bdf2", fsi::TimeScheme::bdf2}});
  if (time.scheme == fsi::TimeScheme::theta) {
    time.theta = table.number_or("theta", time.theta, base::between(0.5, 1));
  } else if (table.has("theta")) {
    throw UserError(table.place("theta") + " belongs to scheme = \"theta\"", "scheme = \"bdf2\"",
                    "write scheme = \"theta\", or leave theta out");
  }
  time.smallest_step = table.number_or("smallest_dt", time.smallest_step, base::between(0, time.step), "s");
  read_adaptive_step(table, time);
}

}  // namespace vocalis::coupling
