#include "coupling/flow/duct_piston.hpp"

namespace vocalis::coupling {

std::array<double, 3> velocity(const DuctPiston& duct, const std::array<double, 3>&, double time) {
  return {acoustic::GaussianFlux(duct.pulse).value(time), 0, 0};
}

double pressure(const DuctPiston& duct, const std::array<double, 3>& point, double time) {
  return duct.density * acoustic::GaussianFlux(duct.pulse).rate(time) * (duct.start + duct.length - point[0]);
}

}  // namespace vocalis::coupling
