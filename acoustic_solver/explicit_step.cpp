#include "acoustic_solver/explicit_step.hpp"

#include <cmath>

#include "acoustic_solver/leap_frog.hpp"

namespace vocalis::acoustic {

ExplicitStep::ExplicitStep(const mesh::Mesh& mesh, const fem::Space& space, const WaveOperator& wave, double density)
    : mesh_(&mesh), space_(&space), wave_(&wave), density_(density), moving_(mesh, space, wave, density) {}

StillLeapFrog& ExplicitStep::still() {
  if (!still_) still_ = std::make_unique<StillLeapFrog>(*mesh_, *space_, *wave_, density_);
  return *still_;
}

double ExplicitStep::stable_step(bool moves) {
  const double eigenvalue = moves ? eigenvalue_bound(*mesh_, *wave_, lumped_terms(*mesh_, *space_, *wave_), density_)
                                  : still().largest_eigenvalue();
  return std::sqrt(stable_product(mesh_->dimension) / eigenvalue);
}

bool ExplicitStep::advance(const SubStep& step, int parts, State& state, AdvanceReport& report) {
  const bool is_finite = step.convects ? moving_.advance(step, parts, state) : still().advance(step, parts, state);
  if (!is_finite) {
    report.converged = false;
    report.reason = "the explicit step is unstable, or its source is not finite";
    return false;
  }
  // `earlier` serves the implicit integrator, whose steps are other ones.
  state.earlier.clear();
  state.rates = {};
  state.has_rates = false;
  return true;
}

}  // namespace vocalis::acoustic
