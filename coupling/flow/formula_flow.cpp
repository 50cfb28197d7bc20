#include "coupling/flow/formula_flow.hpp"

#include <limits>

namespace vocalis::coupling {

double FormulaFlow::end() const { return std::numeric_limits<double>::infinity(); }

FlowSnapshot FormulaFlow::snapshot(long, double time) const {
  const mesh::Mesh& mesh = scene_.flow->mesh;
  const int d = mesh.dimension;
  FlowSnapshot result;
  result.time = time;
  result.displacement.assign(mesh.coordinates.size(), 0.0);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    std::array<double, 3> point = {0, 0, 0};
    std::copy_n(mesh.point(v), d, point.begin());
    result.pressure.push_back(std::visit([&](const auto& flow) { return pressure(flow, point, time); }, formula_));
    const auto u = std::visit([&](const auto& flow) { return velocity(flow, point, time); }, formula_);
    result.velocity.insert(result.velocity.end(), u.begin(), u.begin() + d);
  }
  return result;
}

}  // namespace vocalis::coupling
