#include <algorithm>

#include "core/base/error.hpp"
#include "coupling/case/case_sections.hpp"

namespace vocalis::coupling {

namespace {

/// The contact medium is stiffer and more viscous than the solids that touch: a softer one flows out from between them
/// (docs/validation.md).
constexpr double stiffness_over_solids = 10, damping_over_solids = 3;

double largest(const std::vector<fsi::SolidMaterial>& solids, double fsi::SolidMaterial::*property) {
  double result = 0;
  for (const fsi::SolidMaterial& solid : solids) result = std::max(result, solid.*property);
  return result;
}

/// Of a layer that slides, by default: it must hold the layer's inside, and should not hold the walls.
double film_viscosity(const fsi::ContactMedium& medium, double fluid_viscosity) {
  return std::max(fluid_viscosity, medium.damping / 20);
}

}  // namespace

void read_contact(base::Table& root, Case& config) {
  auto table = root.table_if("contact");
  if (!table) return;
  const auto is_fluid = [](const Region& region) { return region.kind == RegionKind::fluid; };
  const bool has_fluid = std::any_of(config.regions.begin(), config.regions.end(), is_fluid);
  if (!config.flow || !has_fluid || config.flow->solids.empty()) {
    throw base::UserError(table->place() + " needs a flow with a region of fluid and one of solid", "one is missing",
                          "leave [contact] out: nothing can touch");
  }
  contact::ContactSettings& settings = config.contact.emplace();
  settings.alpha = table->number_or("alpha", settings.alpha, base::positive);
  settings.beta = table->number_or("beta", settings.beta, base::positive);
  settings.gamma = table->number_or("gamma", settings.gamma, base::inside(0, 1));
  settings.release_gap = table->number_or("release_gap", settings.release_gap, base::not_negative);
  settings.distance = table->choice_or<contact::DistanceMethod>(
      "distance", settings.distance,
      {{"direct", contact::DistanceMethod::direct}, {"eikonal", contact::DistanceMethod::eikonal}});
  fsi::ContactMedium& medium = config.flow->contact.emplace();
  const std::vector<fsi::SolidMaterial>& solids = config.flow->solids;
  medium.young_modulus =
      table->number_or("young_modulus", stiffness_over_solids * largest(solids, &fsi::SolidMaterial::young_modulus),
                       base::positive, "Pa");
  medium.damping = table->number_or("damping", damping_over_solids * largest(solids, &fsi::SolidMaterial::damping),
                                    base::not_negative, "Pa s");
  medium.friction = table->choice_or<fsi::Friction>("friction", medium.friction,
                                                    {{"full", fsi::Friction::full}, {"none", fsi::Friction::none}});
  if (medium.friction == fsi::Friction::none) {
    medium.film_viscosity =
        table->number_or("film_viscosity", film_viscosity(medium, config.flow->viscosity), base::not_negative, "Pa s");
  }
  config.flow->mesh_recovery = table->number_or("mesh_recovery", 10 * config.time.step, base::not_negative, "s");
}

}  // namespace vocalis::coupling
