#include "coupling/analogies/pressure_source.hpp"

#include "core/fem/simplex.hpp"
#include "core/mesh/geometry.hpp"
#include "coupling/analogies/flow_cell.hpp"

namespace vocalis::coupling {

namespace {

/// ∂t p|χ over the whole step [Pa/s].
std::vector<double> difference_rate(const FlowView& flow) {
  const double dt = flow.time_end - flow.time_begin;
  std::vector<double> rate(flow.pressure_end.size());
  for (std::size_t v = 0; v < rate.size(); ++v) rate[v] = (flow.pressure_end[v] - flow.pressure_begin[v]) / dt;
  return rate;
}

/// ∫_K Q φ_k dx for nodal Q. Silent vertices have no rate, and cells with one no ∇p.
template <int Dimension>
void add_volume_source(const FlowView& flow, const AnalogyMedium& medium, std::span<const double> velocity,
                       const std::vector<double>& rate, fem::Load& load) {
  constexpr int corners = Dimension + 1;
  const mesh::Mesh& mesh = *flow.space->mesh;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (!flow.cell_is_fluid[cell]) continue;
    const auto vertices = mesh.vertices_of(cell);
    const auto geometry = geometry_of_cell<Dimension>(flow, vertices);
    std::array<double, Dimension> gradient = {};
    for (int i = 0; !has_silent_vertex(flow, vertices) && i < corners; ++i) {
      const double pressure = 0.5 * (flow.pressure_begin[vertices[i]] + flow.pressure_end[vertices[i]]);
      for (int k = 0; k < Dimension; ++k) gradient[k] += pressure * geometry.gradient[i][k];
    }
    std::array<double, corners> source;
    double total = 0;
    for (int i = 0; i < corners; ++i) {
      const std::int32_t v = vertices[i];
      double convected = 0;
      for (int k = 0; k < Dimension; ++k) convected += velocity[v * Dimension + k] * gradient[k];
      source[i] = is_silent(flow, v) ? 0 : pressure_source_density(rate[v], convected, medium);
      if (!medium.window.empty()) source[i] *= medium.window[v];
      total += source[i];
    }
    const double weight = geometry.measure / ((Dimension + 1) * (Dimension + 2));
    for (int i = 0; i < corners; ++i) load.values[vertices[i]] += weight * (total + source[i]);
  }
}

/// ∫ u·n φ_k ds over the outlet, which stands still.
void add_outlet_flux(const FlowView& flow, const AnalogyMedium& medium, const std::vector<double>& velocity,
                     fem::Load& load) {
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
      if (!medium.window.empty()) normal_velocity[i] *= medium.window[corners[i]];
      total += normal_velocity[i];
    }
    const double weight = geometry.measure / (d * (d + 1));
    for (int i = 0; i < d; ++i) load.values[corners[i]] += weight * (total + normal_velocity[i]);
  }
}

fem::Load volume_load(const FlowView& flow, const AnalogyMedium& medium, std::span<const double> velocity,
                      const std::vector<double>& rate) {
  fem::Load load(*flow.space, 1);
  if (flow.space->mesh->dimension == 2) {
    add_volume_source<2>(flow, medium, velocity, rate, load);
  } else {
    add_volume_source<3>(flow, medium, velocity, rate, load);
  }
  return load;
}

}  // namespace

AnalogySource pressure_source(const FlowView& flow, const AnalogyMedium& medium, std::span<const double> velocity) {
  AnalogySource result;
  if (flow.pressure_rate_begin.empty()) {
    result.begin = result.end = volume_load(flow, medium, velocity, difference_rate(flow));
  } else {
    result.begin = volume_load(flow, medium, velocity, flow.pressure_rate_begin);
    result.end = volume_load(flow, medium, velocity, flow.pressure_rate_end);
  }
  add_outlet_flux(flow, medium, flow.velocity_begin, result.begin);
  add_outlet_flux(flow, medium, flow.velocity_end, result.end);
  return result;
}

}  // namespace vocalis::coupling
