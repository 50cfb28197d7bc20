#pragma once

#include <functional>
#include <vector>

#include "core/fem/field.hpp"
#include "coupling/voice/voice.hpp"

namespace vocalis::coupling::test {

/// A fluid at rest on a plane flow mesh that moves along x. The scene must outlive it.
class SwingingMesh {
 public:
  /// displacement  [m] of the place x at rest, at the time t
  SwingingMesh(const Scene& scene, std::function<double(double x, double t)> displacement)
      : scene_(scene),
        space_(fem::lagrange(scene.flow->mesh, 1)),
        is_fluid_(fluid_cells(scene)),
        displacement_(std::move(displacement)) {}

  fem::Field displacement(double time) const {
    fem::Field result(space_, 2);
    for (std::int32_t v = 0; v < space_.num_dofs(); ++v) {
      result.at(v)[0] = displacement_(scene_.flow->mesh.point(v)[0], time);
    }
    return result;
  }

  FlowView view(double begin, double end) const {
    const mesh::Mesh& mesh = scene_.flow->mesh;
    FlowView view;
    view.space = &space_;
    view.time_begin = begin;
    view.time_end = end;
    view.cell_is_fluid = is_fluid_;
    const fem::Field first = displacement(begin), last = displacement(end);
    for (std::size_t i = 0; i < mesh.coordinates.size(); ++i) {
      view.coordinates_middle.push_back(mesh.coordinates[i] + 0.5 * (first.values[i] + last.values[i]));
      view.mesh_velocity.push_back((last.values[i] - first.values[i]) / (end - begin));
    }
    view.velocity_begin = view.velocity_end = std::vector<double>(mesh.coordinates.size(), 0.0);
    view.pressure_begin = view.pressure_end = std::vector<double>(mesh.num_vertices(), 0.0);
    return view;
  }

 private:
  const Scene& scene_;
  fem::Space space_;
  std::vector<std::int32_t> is_fluid_;
  std::function<double(double, double)> displacement_;
};

}  // namespace vocalis::coupling::test
