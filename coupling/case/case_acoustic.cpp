#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "coupling/case/case_sections.hpp"

namespace vocalis::coupling {

namespace {

using acoustic::Integrator;
using base::UserError;
using Contact = acoustic::ContactCells;
using Kind = acoustic::AcousticBoundaryKind;
using Velocity = acoustic::VelocityElements;

// Removes what folds that swing feed into cells far smaller than c dt, and widens a resonance of 5 kHz by 0.2 Hz at
// steps of 12.5 us: docs/theory.md, "Time of sound".
constexpr double kRadiusOfMovingMesh = 0.8;

acoustic::AcousticBoundary read_boundary(base::Table& table, Case& config) {
  acoustic::AcousticBoundary boundary;
  boundary.group = read_group(table, config);
  boundary.kind = table.choice<Kind>("kind", {{"rigid", Kind::rigid},
                                              {"admittance", Kind::admittance},
                                              {"yielding", Kind::yielding},
                                              {"viscothermal", Kind::viscothermal},
                                              {"open", Kind::open},
                                              {"pressure_release", Kind::pressure_release}});
  if (boundary.kind == Kind::admittance) {
    boundary.admittance = table.number_or("admittance", boundary.admittance, base::not_negative);
  }
  if (boundary.kind == Kind::yielding) {
    boundary.mass = table.number_or("mass", boundary.mass, base::positive, "kg/m^2");
    boundary.resistance = table.number_or("resistance", boundary.resistance, base::not_negative, "Pa s/m");
    boundary.stiffness = table.number_or("stiffness", boundary.stiffness, base::not_negative, "Pa/m");
  }
  if (boundary.kind == Kind::viscothermal) {
    boundary.kinematic_viscosity =
        table.number_or("kinematic_viscosity", boundary.kinematic_viscosity, base::positive, "m^2/s");
    boundary.thermal_diffusivity =
        table.number_or("thermal_diffusivity", boundary.thermal_diffusivity, base::not_negative, "m^2/s");
    boundary.heat_capacity_ratio =
        table.number_or("heat_capacity_ratio", boundary.heat_capacity_ratio, base::between(1, 2));
  }
  if (boundary.kind == Kind::open) {
    boundary.radius = table.number_or("radius", boundary.radius, base::not_negative, "m");
  }
  return boundary;
}

acoustic::AbsorbingLayer read_layer(base::Table& table) {
  using Side = acoustic::BoxSide;
  const std::vector<std::pair<std::string, Side>> names = {{"x_min", Side::x_min}, {"x_max", Side::x_max},
                                                           {"y_min", Side::y_min}, {"y_max", Side::y_max},
                                                           {"z_min", Side::z_min}, {"z_max", Side::z_max}};
  acoustic::AbsorbingLayer layer;
  layer.kind = table.choice<acoustic::LayerKind>(
      "kind", {{"pml", acoustic::LayerKind::pml}, {"sponge", acoustic::LayerKind::sponge}});
  for (const std::string& side : table.texts("sides")) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const auto& pair) { return pair.first == side; });
    if (found == names.end()) {
      throw UserError(table.place("sides") + " are sides of the mesh's box", "\"" + side + "\"",
                      "use some of x_min, x_max, y_min, y_max, z_min, z_max");
    }
    layer.sides.push_back(found->second);
  }
  layer.thickness = table.number("thickness", base::positive, "m");
  layer.reflection = table.number_or("reflection", layer.reflection, base::inside(0, 1));
  return layer;
}

/// A mesh besides the case's; the groups of the last `boundaries` references are those of that mesh.
std::optional<AcousticMesh> read_own_mesh(MPI_Comm comm, base::Table& table, const acoustic::AcousticSettings& solver,
                                          std::size_t boundaries, Case& config) {
  auto mesh = table.table_if("mesh");
  if (!mesh) return {};
  if (solver.contact_cells == Contact::strip) {
    throw UserError(table.place("contact_cells") + " = \"strip\" needs the cells of the flow",
                    "[[acoustic]] \"" + solver.name + "\" with a mesh of its own",
                    "write contact_cells = \"keep\", or leave the mesh out");
  }
  for (auto reference = config.references.end() - static_cast<std::ptrdiff_t>(boundaries);
       reference != config.references.end(); ++reference) {
    reference->acoustic = solver.name;
  }
  AcousticMesh own = {.table = solver.name, .mesh = read_mesh(comm, *mesh, config), .flow_ends = {}};
  if (!config.has_flow()) return own;
  if (mesh->has("flow_ends")) own.flow_ends = read_groups(*mesh, config, "flow_ends");
  own.follows_flow = mesh->boolean_or("follows_flow", false);
  return own;
}

double read_step(base::Table& table, const Case& config) {
  if (config.time.step > 0) return table.number_or("dt", config.time.step, base::positive, "s");
  return table.number("dt", base::positive, "s");
}

}  // namespace

void read_acoustics(MPI_Comm comm, base::Table& root, Case& config) {
  std::vector<std::string> names;
  for (base::Table& table : root.tables("acoustic")) {
    acoustic::AcousticSettings solver;
    solver.name = read_plain_name_or(table, "name", solver.name);
    const std::vector<acoustic::AnalogySettings> analogies = read_analogies(table, config);
    solver.speed_of_sound = table.number_or("speed_of_sound", solver.speed_of_sound, base::positive, "m/s");
    solver.density = table.number_or("density", solver.density, base::positive, "kg/m^3");
    solver.wall_admittance = table.number_or("wall_admittance", solver.wall_admittance, base::not_negative);
    solver.step = read_step(table, config);
    solver.integrator = table.choice_or<Integrator>(
        "integrator", Integrator::automatic,
        {{"auto", Integrator::automatic}, {"implicit", Integrator::implicit}, {"explicit", Integrator::leap_frog}});
    solver.solver_tolerance = table.number_or("solver_tolerance", solver.solver_tolerance, base::inside(0, 1));
    solver.velocity_elements = table.choice_or<Velocity>("velocity_elements", solver.velocity_elements,
                                                         {{"P0", Velocity::p0}, {"P1", Velocity::p1}});
    if (solver.velocity_elements == Velocity::p1) {
      solver.subscale_constant = table.number_or("subscale_constant", solver.subscale_constant, base::not_negative);
    }
    if (config.has_flow()) {
      solver.contact_cells = table.choice_or<Contact>("contact_cells", solver.contact_cells,
                                                      {{"keep", Contact::keep}, {"strip", Contact::strip}});
    }
    std::vector<std::string> groups;
    for (base::Table& boundary : table.tables("boundary")) {
      solver.boundaries.push_back(read_boundary(boundary, config));
      groups.push_back(solver.boundaries.back().group);
    }
    reject_duplicates(table, "[[acoustic.boundary]]", groups, "group");
    const auto own_mesh = read_own_mesh(comm, table, solver, groups.size(), config);
    const bool moves = config.may_move() && (!own_mesh || own_mesh->follows_flow);
    solver.spectral_radius = table.number_or(
        "spectral_radius", moves && solver.integrator != Integrator::leap_frog ? kRadiusOfMovingMesh : 1,
        base::between(0, 1));
    for (base::Table& layer : table.tables("layer")) solver.layers.push_back(read_layer(layer));
    for (const acoustic::AnalogySettings& analogy : analogies) {
      config.acoustics.push_back(solver);
      config.acoustics.back().analogy = analogy;
      if (analogies.size() > 1) config.acoustics.back().name = solver.name + "_" + analogy.name;
      names.push_back(config.acoustics.back().name);
      if (own_mesh) config.acoustic_meshes[names.back()] = *own_mesh;
    }
  }
  reject_duplicates(root, "[[acoustic]]", names);
  if (config.time.step > 0) return;
  for (const acoustic::AcousticSettings& solver : config.acoustics) {
    config.time.step = std::max(config.time.step, solver.step);
  }
}

}  // namespace vocalis::coupling
