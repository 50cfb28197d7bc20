#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/base/error.hpp"
#include "fsi_solver/continuum.hpp"
#include "fsi_solver/fsi_solver.hpp"
#include "tests/coupling/small_scene.hpp"

namespace vocalis::coupling::test {

using Vector = std::function<fem::Point(const fem::Point&)>;  ///< of the reference point

inline const Vector rest = [](const fem::Point&) { return fem::Point{0, 0, 0}; };
inline constexpr fsi::Elements both_elements[] = {fsi::Elements::p1p1, fsi::Elements::p2p1};

/// A flow to be watched, which is set and never solved: air in a box [0, length] x [0, 1] (x [0, 0.5]), and from x =
/// `solid_from` on a solid. cells  along x and y; two along z.
struct WatchedFlow {
  std::unique_ptr<Scene> scene;
  fsi::FsiSolver flow;

  WatchedFlow(int dimension, double length, double solid_from, std::array<int, 2> cells, fsi::Elements elements,
              const std::optional<fsi::ContactMedium>& contact, double dt)
      : scene(box_scene({length, 1, dimension == 2 ? 0 : 0.5}, {cells[0], cells[1], 2},
                        [solid_from](const fem::Point& centre) {
                          return centre[0] < solid_from ? RegionKind::fluid : RegionKind::solid;
                        })),
        flow(scene->flow->mesh, settings(elements, contact), {.end = 1, .step = dt}) {}

  /// Calls set(dof, reference point) for each velocity function of this rank.
  template <class Set>
  void at_each_point(const Set& set) const {
    const std::vector<double>& points = flow.continuum().reference_points;
    const int d = scene->parent.dimension;
    for (std::int32_t dof = 0; dof < flow.velocity_space().num_dofs(); ++dof) {
      fem::Point point = {0, 0, 0};
      for (int k = 0; k < d; ++k) point[k] = points[static_cast<std::size_t>(dof) * d + k];
      set(dof, point);
    }
  }

 private:
  static fsi::FlowSettings settings(fsi::Elements elements, const std::optional<fsi::ContactMedium>& contact) {
    fsi::FlowSettings result;
    result.elements = elements;
    result.solids = {{.region = "solid", .young_modulus = 1e5}};
    result.contact = contact;
    return result;
  }
};

/// The words of the UserError that the work throws.
template <class Work>
std::string message_of(const Work& work) {
  try {
    work();
  } catch (const base::UserError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace vocalis::coupling::test
