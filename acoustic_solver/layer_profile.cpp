#include "acoustic_solver/layer_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/geometry.hpp"

namespace vocalis::acoustic {

namespace {

using base::UserError;

constexpr double kLeastCells = 2;
constexpr double kMostDampingOfCell =
    1.2;  ///< s h / c at the end of a layer; from 1.7 on edges grow (docs/stability.md)

struct Extent {
  double low, high;
};

Extent extent_of(const mesh::Mesh& mesh, int axis) {
  Extent extent = {std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    extent.low = std::min(extent.low, mesh.point(v)[axis]);
    extent.high = std::max(extent.high, mesh.point(v)[axis]);
  }
  return {base::smallest(mesh.comm, extent.low), base::largest(mesh.comm, extent.high)};
}

double depth(const LayerSide& side, double x) { return (x - side.inner) / (side.outer - side.inner); }

/// Mean length along the axis of the cells with their centre in the layer; infinite if there is none. Collective.
double cell_length(const mesh::Mesh& mesh, const LayerSide& side) {
  double lengths = 0, count = 0;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest(), centre = 0;
    for (const std::int32_t v : mesh.vertices_of(cell)) {
      const double x = mesh.point(v)[side.axis];
      low = std::min(low, x);
      high = std::max(high, x);
      centre += x / (mesh.dimension + 1);
    }
    if (depth(side, centre) <= 0) continue;
    lengths += high - low;
    ++count;
  }
  lengths = base::sum(mesh.comm, lengths);
  count = base::sum(mesh.comm, count);
  return count > 0 ? lengths / count : std::numeric_limits<double>::infinity();
}

void check(const AcousticSettings& settings, const AbsorbingLayer& layer) {
  if (!(layer.thickness > 0)) {
    throw UserError(fmt::format("the thickness [m] of a layer of acoustic solver '{}' is positive", settings.name),
                    fmt::format("{}", layer.thickness), "set thickness to twelve cells or more");
  }
  if (!(layer.reflection > 0 && layer.reflection < 1)) {
    throw UserError(
        fmt::format("the reflection of a layer of acoustic solver '{}' lies between 0 and 1", settings.name),
        fmt::format("{}", layer.reflection), "leave it out: the default is a measured choice");
  }
  if (layer.kind != settings.layers.front().kind) {
    throw UserError(fmt::format("all layers of acoustic solver '{}' are of one kind", settings.name), "both kinds",
                    "take pml for all: it reflects least");
  }
}

/// Whether perfectly matched layers cross along edges that go through the mesh from end to end.
bool have_closed_edges(const mesh::Mesh& mesh, const AcousticSettings& settings) {
  std::set<int> axes;
  for (const AbsorbingLayer& layer : settings.layers) {
    if (layer.kind != LayerKind::pml) return false;
    for (const BoxSide side : layer.sides) axes.insert(static_cast<int>(side) / 2);
  }
  return mesh.dimension == 3 && axes.size() == 2;
}

LayerSide layer_side(const mesh::Mesh& mesh, const AcousticSettings& settings, const AbsorbingLayer& layer,
                     BoxSide which) {
  const int axis = static_cast<int>(which) / 2;
  const bool upper = static_cast<int>(which) % 2 == 1;
  if (axis >= mesh.dimension) {
    throw UserError("the sides of a layer in the plane are x_min, x_max, y_min and y_max", upper ? "z_max" : "z_min",
                    "leave it out");
  }
  const Extent extent = extent_of(mesh, axis);
  LayerSide side;
  side.axis = axis;
  side.outer = upper ? extent.high : extent.low;
  side.inner = upper ? extent.high - layer.thickness : extent.low + layer.thickness;
  side.greatest = -settings.speed_of_sound * std::log(layer.reflection) / layer.thickness;
  if (layer.thickness >= extent.high - extent.low) {
    throw UserError(fmt::format("the layers of acoustic solver '{}' leave room for sound", settings.name),
                    fmt::format("thickness {} m of {} m", layer.thickness, extent.high - extent.low),
                    "make the layer thinner or the air wider");
  }
  const double length = cell_length(mesh, side);
  if (layer.thickness < kLeastCells * length) {
    throw UserError(fmt::format("a layer of acoustic solver '{}' is at least two cells thick", settings.name),
                    fmt::format("thickness {} m, cells of {:.3g} m", layer.thickness, length),
                    "make it twelve cells thick or more");
  }
  if (!layer.may_grow && have_closed_edges(mesh, settings) &&
      side.greatest * length > kMostDampingOfCell * settings.speed_of_sound) {
    throw UserError(
        fmt::format("where layers of acoustic solver '{}' absorb along two of three axes they are at least {:.2g} "
                    "cells thick: in thinner ones sound grows",
                    settings.name, -std::log(layer.reflection) / kMostDampingOfCell),
        fmt::format("thickness {} m, cells of {:.3g} m", layer.thickness, length),
        "make it twelve cells thick or more, or absorb along the third axis too");
  }
  return side;
}

}  // namespace

std::vector<LayerSide> layer_sides(const mesh::Mesh& mesh, const AcousticSettings& settings) {
  std::vector<LayerSide> sides;
  for (const AbsorbingLayer& layer : settings.layers) {
    check(settings, layer);
    for (const BoxSide which : layer.sides) {
      const LayerSide side = layer_side(mesh, settings, layer, which);
      for (const LayerSide& other : sides) {
        const bool same = other.axis == side.axis && other.outer == side.outer;
        const bool meets = other.axis == side.axis && depth(side, other.inner) > 0;
        if (!same && !meets) continue;
        throw UserError(fmt::format("the layers of acoustic solver '{}' do not overlap on one axis", settings.name),
                        same ? "one side twice" : "layers of opposite sides meet",
                        same ? "name each side once" : "make them thinner or the air wider");
      }
      sides.push_back(side);
    }
  }
  return sides;
}

double damping_up_to(const std::vector<LayerSide>& sides, int axis, double x) {
  double sum = 0;
  for (const LayerSide& side : sides) {
    if (side.axis != axis) continue;
    const double part = std::max(0.0, depth(side, x));
    sum += 0.5 * side.greatest * part * part * (side.outer - side.inner);
  }
  return sum;
}

bool ends_a_layer(const mesh::Mesh& mesh, const std::vector<LayerSide>& sides, const mesh::NamedFacet& facet) {
  const auto vertices = mesh::facet_vertices(mesh, facet.cell, facet.index);
  return std::any_of(sides.begin(), sides.end(), [&](const LayerSide& side) {
    return std::all_of(vertices.begin(), vertices.begin() + mesh.dimension,
                       [&](std::int32_t v) { return depth(side, mesh.point(v)[side.axis]) > 1 - 1e-6; });
  });
}

}  // namespace vocalis::acoustic
