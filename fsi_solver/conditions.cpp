#include "fsi_solver/conditions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "core/mesh/geometry.hpp"

namespace vocalis::fsi {

namespace {

using mesh::Mesh;
using mesh::NamedFacet;

/// The axis that the normal of a facet is parallel to, or -1.
int axis_of(const Mesh& mesh, const NamedFacet& facet) {
  const auto normal = mesh::facet_geometry(mesh, facet.cell, facet.index).normal;
  for (int k = 0; k < mesh.dimension; ++k) {
    if (std::abs(normal[k]) > 1 - 1e-8) return k;
  }
  return -1;
}

/// Profile with mean 1 and zero rim: a parabola between the two farthest points of the group, a paraboloid on a disc.
class Profile {
 public:
  Profile(const Mesh& mesh, const std::vector<NamedFacet>& facets) : d_(mesh.dimension) {
    std::vector<double> here;
    for (const NamedFacet& facet : facets) {
      const auto corners = mesh::facet_vertices(mesh, facet.cell, facet.index);
      for (int i = 0; i < d_; ++i) here.insert(here.end(), mesh.point(corners[i]), mesh.point(corners[i]) + d_);
    }
    const std::vector<double> points = base::concatenate_all(mesh.comm, here);
    // The point farthest from any point, then the one farthest from that: the ends of a straight line or of a disc.
    const auto farthest = [&](const double* from) {
      const double* best = from;
      for (std::size_t i = 0; i < points.size(); i += d_) {
        if (distance(from, &points[i]) > distance(from, best)) best = &points[i];
      }
      return best;
    };
    if (points.empty()) return;
    const double* a = farthest(points.data());
    const double* b = farthest(a);
    for (int k = 0; k < d_; ++k) centre_[k] = 0.5 * (a[k] + b[k]);
    radius_ = 0.5 * distance(a, b);
  }
  double operator()(const double* point) const {
    const double r = distance(point, centre_) / radius_;
    return (d_ == 2 ? 1.5 : 2.0) * std::max(0.0, 1 - r * r);
  }

 private:
  double distance(const double* a, const double* b) const {
    double sum = 0;
    for (int k = 0; k < d_; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return std::sqrt(sum);
  }
  int d_;
  double centre_[3] = {0, 0, 0};
  double radius_ = 1;
};

/// What each component at each dof obeys, while the boundaries are gone through.
class Book {
 public:
  /// points  (dofs, dimension) [m]
  Book(const std::vector<double>& points, int dimension) : points_(points), d_(dimension), of_(points.size()) {}

  /// axis -1: all components
  void hold(const std::vector<std::int32_t>& marks, int axis) {
    visit(marks, axis, [](PrescribedComponent& entry, std::size_t) {
      entry.boundary = -1;
      entry.factor = 1;
    });
  }
  void drive(const std::vector<std::int32_t>& marks, int boundary, const std::function<double(const double*)>& factor) {
    visit(marks, -1, [&](PrescribedComponent& entry, std::size_t dof) {
      entry.boundary = boundary;
      entry.factor = factor(points_.data() + dof * d_);
    });
  }
  std::vector<PrescribedComponent> list() const {
    std::vector<PrescribedComponent> result;
    for (std::size_t i = 0; i < of_.size(); ++i) {
      if (!known_[i]) continue;
      result.push_back(of_[i]);
      result.back().dof = static_cast<std::int32_t>(i / d_);
      result.back().component = static_cast<int>(i % d_);
    }
    return result;
  }

 private:
  template <class Change>
  void visit(const std::vector<std::int32_t>& marks, int axis, Change change) {
    for (std::size_t dof = 0; dof < marks.size(); ++dof) {
      if (!marks[dof]) continue;
      for (int k = 0; k < d_; ++k) {
        if (axis >= 0 && k != axis) continue;
        known_[dof * d_ + k] = 1;
        change(of_[dof * d_ + k], dof);
      }
    }
  }
  const std::vector<double>& points_;
  int d_;
  std::vector<PrescribedComponent> of_;
  std::vector<char> known_ = std::vector<char>(of_.size(), 0);
};

bool holds_velocity(FlowBoundaryKind kind) { return kind == FlowBoundaryKind::wall || kind == FlowBoundaryKind::fixed; }

/// The exterior facets of the fluid that are walls: named so, or not named by any boundary.
std::vector<NamedFacet> wall_facets(const Continuum& continuum, const std::vector<FlowBoundary>& boundaries) {
  const Mesh& mesh = *continuum.mesh;
  std::vector<char> taken(mesh.cell_neighbours.size(), 0);
  const auto position = [&](const NamedFacet& facet) {
    return static_cast<std::size_t>(facet.cell) * (mesh.dimension + 1) + facet.index;
  };
  for (const FlowBoundary& boundary : boundaries) {
    if (holds_velocity(boundary.kind)) continue;
    for (const NamedFacet& facet : mesh::exterior_facets_of_group(mesh, boundary.group)) taken[position(facet)] = 1;
  }
  std::vector<NamedFacet> result = mesh::boundary_facets(mesh);
  std::erase_if(
      result, [&](const NamedFacet& facet) { return continuum.cell_solid[facet.cell] >= 0 || taken[position(facet)]; });
  return result;
}

/// The exterior facets of a boundary. Throws UserError where the mesh has no such group, or the group no facet at which
/// fluid or solid ends. Collective.
std::vector<NamedFacet> facets_of(const Mesh& mesh, const FlowBoundary& boundary) {
  if (mesh::index_of(mesh.group_names, boundary.group) < 0) {
    throw base::UserError("a boundary must name a group of facets of the mesh", boundary.group,
                          base::did_you_mean(boundary.group, mesh.group_names));
  }
  std::vector<NamedFacet> facets = mesh::exterior_facets_of_group(mesh, boundary.group);
  if (base::sum(mesh.comm, static_cast<std::int64_t>(facets.size())) == 0) {
    throw base::UserError("a boundary of the flow must lie where fluid or solid ends",
                          "\"" + boundary.group + "\", which has no facet there",
                          "name another group, or leave this boundary out");
  }
  return facets;
}

}  // namespace

Conditions make_conditions(const Continuum& continuum, const FlowSettings& settings) {
  const Mesh& mesh = *continuum.mesh;
  const int d = mesh.dimension;
  Conditions result;
  result.boundaries = settings.boundaries;
  Book velocity(continuum.reference_points, d), motion(mesh.coordinates, d);
  const fem::Space& space = continuum.velocity_space;
  const auto hold_mesh = [&](std::vector<NamedFacet> facets, int axis) {
    std::erase_if(facets, [&](const NamedFacet& facet) { return continuum.cell_solid[facet.cell] >= 0; });
    motion.hold(mesh::mark_vertices(mesh, facets), axis);
  };
  // Later entries override: driven boundaries, then symmetries, then walls.
  for (std::size_t i = 0; i < settings.boundaries.size(); ++i) {
    const FlowBoundary& boundary = settings.boundaries[i];
    const std::vector<NamedFacet> facets = facets_of(mesh, boundary);
    const auto index = static_cast<int>(i);
    if (boundary.kind == FlowBoundaryKind::velocity) {
      const std::vector<std::int32_t> marks = mark_dofs(space, facets);
      if (boundary.profile == VelocityProfile::parabolic) {
        velocity.drive(marks, index, Profile(mesh, facets));
      } else {
        velocity.drive(marks, index, [](const double*) { return 1.0; });
      }
    } else if (boundary.kind == FlowBoundaryKind::pressure || boundary.kind == FlowBoundaryKind::total_pressure ||
               boundary.kind == FlowBoundaryKind::outlet) {
      for (const NamedFacet& facet : facets) result.tractions.push_back({facet.cell, facet.index, index});
      result.sets_pressure_level = true;
    }
    if (boundary.kind != FlowBoundaryKind::symmetry) hold_mesh(facets, -1);
  }
  for (const FlowBoundary& boundary : settings.boundaries) {
    if (boundary.kind != FlowBoundaryKind::symmetry) continue;
    const std::vector<NamedFacet> facets = mesh::exterior_facets_of_group(mesh, boundary.group);
    std::int32_t oblique = 0;
    for (const NamedFacet& facet : facets) oblique += axis_of(mesh, facet) < 0;
    if (base::largest(mesh.comm, oblique) > 0) {
      throw base::UserError("a symmetry must be straight and parallel to the axes", boundary.group,
                            "turn the geometry, or choose another kind of boundary");
    }
    for (int axis = 0; axis < d; ++axis) {
      std::vector<NamedFacet> normal_to_axis = facets;
      std::erase_if(normal_to_axis, [&](const NamedFacet& facet) { return axis_of(mesh, facet) != axis; });
      velocity.hold(mark_dofs(space, normal_to_axis), axis);
      hold_mesh(normal_to_axis, axis);
    }
  }
  for (const FlowBoundary& boundary : settings.boundaries) {
    if (holds_velocity(boundary.kind)) {
      velocity.hold(mark_dofs(space, mesh::exterior_facets_of_group(mesh, boundary.group)), -1);
    }
  }
  const std::vector<NamedFacet> walls = wall_facets(continuum, settings.boundaries);
  velocity.hold(mark_dofs(space, walls), -1);
  hold_mesh(walls, -1);
  result.components = velocity.list();
  result.mesh_is_held.assign(static_cast<std::size_t>(mesh.num_vertices()) * d, 0);
  for (const PrescribedComponent& held : motion.list()) {
    result.mesh_is_held[static_cast<std::size_t>(held.dof) * d + held.component] = 1;
  }
  return result;
}

double course(const FlowBoundary& boundary, double time) {
  using std::numbers::pi;
  const double risen = time >= boundary.ramp ? 1.0 : 0.5 * (1 - std::cos(pi * std::max(time, 0.0) / boundary.ramp));
  return boundary.period > 0 ? risen * std::sin(2 * pi * time / boundary.period) : risen;
}

void impose(const Conditions& conditions, const Continuum& continuum, const Prescribed& prescribed,
            const std::vector<double>& coordinates, double time, fem::Field& velocity) {
  const int d = continuum.mesh->dimension;
  for (const PrescribedComponent& entry : conditions.components) {
    double value = 0;
    if (entry.boundary >= 0) {
      const FlowBoundary& boundary = conditions.boundaries[entry.boundary];
      if (prescribed.velocity) {
        std::array<double, 3> point = {0, 0, 0};
        const std::vector<double>& from =
            continuum.dof_solid[entry.dof] >= 0 ? continuum.reference_points : coordinates;
        std::copy_n(from.data() + static_cast<std::size_t>(entry.dof) * d, d, point.begin());
        value = prescribed.velocity(point, time)[entry.component];
      } else {
        value = boundary.velocity[entry.component] * entry.factor * course(boundary, time);
      }
    }
    velocity.at(entry.dof)[entry.component] = value;
  }
}

}  // namespace vocalis::fsi
