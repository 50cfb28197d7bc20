#include "coupling/analogies/pressure_rate.hpp"

#include <algorithm>

#include "core/fem/simplex.hpp"
#include "core/mesh/geometry.hpp"

namespace vocalis::coupling {

namespace {

/// ∫_K Q φ_k dx for nodal Q, with the geometry of mid-step. Silent vertices have no rate, and cells with one no ∇p.
template <int Dimension>
void add_volume_source(const FlowView& flow, double density, double speed_of_sound, fem::Load& load) {
  constexpr int corners = Dimension + 1;
  const mesh::Mesh& mesh = *flow.space->mesh;
  const double dt = flow.time_end - flow.time_begin;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (!flow.cell_is_fluid[cell]) continue;
    const auto vertices = mesh.vertices_of(cell);
    std::array<const double*, corners> points;
    for (int i = 0; i < corners; ++i) points[i] = flow.coordinates_middle.data() + vertices[i] * Dimension;
    const auto geometry = fem::simplex_geometry<Dimension>(points);
    const auto is_silent = [&](std::int32_t v) { return !flow.vertex_is_silent.empty() && flow.vertex_is_silent[v]; };
    const bool has_gradient = std::none_of(vertices.begin(), vertices.end(), is_silent);
    std::array<double, Dimension> gradient = {};
    for (int i = 0; has_gradient && i < corners; ++i) {
      const double pressure = 0.5 * (flow.pressure_begin[vertices[i]] + flow.pressure_end[vertices[i]]);
      for (int k = 0; k < Dimension; ++k) gradient[k] += pressure * geometry.gradient[i][k];
    }
    std::array<double, corners> source;
    double total = 0;
    for (int i = 0; i < corners; ++i) {
      double convected = 0;
      for (int k = 0; k < Dimension; ++k) convected += flow.mesh_velocity[vertices[i] * Dimension + k] * gradient[k];
      const double rate = (flow.pressure_end[vertices[i]] - flow.pressure_begin[vertices[i]]) / dt;
      source[i] = is_silent(vertices[i]) ? 0 : pressure_rate_density(rate, convected, density, speed_of_sound);
      total += source[i];
    }
    const double weight = geometry.measure / ((Dimension + 1) * (Dimension + 2));
    for (int i = 0; i < corners; ++i) load.values[vertices[i]] += weight * (total + source[i]);
  }
}

/// ∫ u·n φ_k ds over the outlet, which stands still.
void add_outlet_flux(const FlowView& flow, const std::vector<double>& velocity, fem::Load& load) {
  const mesh::Mesh& mesh = *flow.space->mesh;
  const int d = mesh.dimension;
  for (const mesh::NamedFacet& facet : flow.outlet) {
    if (!flow.cell_is_fluid[facet.cell]) continue;
    const auto geometry = mesh::facet_geometry(mesh, facet.cell, facet.index);
    const auto corners = mesh::facet_vertices(mesh, facet.cell, facet.index);
    std::array<double, 3> normal_velocity = {};
    double total = 0;
    for (int i = 0; i < d; ++i) {
      for (int k = 0; k < d; ++k) normal_velocity[i] += velocity[corners[i] * d + k] * geometry.normal[k];
      total += normal_velocity[i];
    }
    const double weight = geometry.measure / (d * (d + 1));
    for (int i = 0; i < d; ++i) load.values[corners[i]] += weight * (total + normal_velocity[i]);
  }
}

}  // namespace

AnalogySource PressureRate::source(const FlowView& flow) const {
  AnalogySource result = {fem::Load(*flow.space, 1), {}};
  if (flow.space->mesh->dimension == 2) {
    add_volume_source<2>(flow, density_, speed_of_sound_, result.begin);
  } else {
    add_volume_source<3>(flow, density_, speed_of_sound_, result.begin);
  }
  result.end = result.begin;
  add_outlet_flux(flow, flow.velocity_begin, result.begin);
  add_outlet_flux(flow, flow.velocity_end, result.end);
  return result;
}

}  // namespace vocalis::coupling
