#include "coupling/analogies/vortex.hpp"

namespace vocalis::coupling {

std::vector<double> VortexSound::head(const FlowView& flow, const std::vector<double>& velocity) const {
  const std::size_t d = flow.space->mesh->dimension;
  std::vector<double> result(velocity.size() / d, 0.0);
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const double weight = medium_.window.empty() ? 1 : medium_.window[i / d];
    result[i / d] += weight * 0.5 * medium_.density * velocity[i] * velocity[i];
  }
  return result;
}

}  // namespace vocalis::coupling
