#include "coupling/analogies/force_source.hpp"

#include "coupling/analogies/flow_cell.hpp"
#include "coupling/analogies/wall_friction.hpp"

namespace vocalis::coupling {

namespace {

template <int Dimension>
void add_momentum(const FlowView& flow, const AnalogyMedium& medium, CarriedMomentum which,
                  const std::vector<double>& velocity, const std::vector<double>& of_edges, fem::Load& load) {
  const mesh::Mesh& mesh = *flow.space->mesh;
  const auto edges = mesh::edges_of_cell(Dimension);
  const double of_head = which == CarriedMomentum::lamb ? 0.5 : 0;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (!flow.cell_is_fluid[cell]) continue;
    const auto vertices = mesh.vertices_of(cell);
    if (has_silent_vertex(flow, vertices)) continue;
    const auto geometry = geometry_of_cell<Dimension>(flow, vertices);
    std::array<double, Dimension> carried = {};
    const auto add = [&](const double* u, const std::array<double, Dimension>& slope, double weight) {
      double along = 0, square = 0;
      for (int k = 0; k < Dimension; ++k) along += u[k] * slope[k];
      for (int k = 0; k < Dimension; ++k) square += u[k] * u[k];
      for (int k = 0; k < Dimension; ++k) carried[k] += weight * (u[k] * along - of_head * square * slope[k]);
    };
    const auto window = [&](std::int32_t v) { return medium.window.empty() ? 1 : medium.window[v]; };
    // Means over the cell of the gradients of the basis: of P1, or of P2 with what edges have.
    const double of_vertex = of_edges.empty() ? 1 : 4.0 / (Dimension + 1) - 1, of_edge = 4.0 / (Dimension + 1);
    for (int i = 0; i <= Dimension; ++i) {
      const std::size_t at = static_cast<std::size_t>(vertices[i]) * Dimension;
      add(velocity.data() + at, geometry.gradient[i], of_vertex * window(vertices[i]));
    }
    for (std::size_t e = 0; !of_edges.empty() && e < edges.size(); ++e) {
      const auto [a, b] = edges[e];
      std::array<double, Dimension> slope;
      for (int k = 0; k < Dimension; ++k) slope[k] = geometry.gradient[a][k] + geometry.gradient[b][k];
      const std::size_t at = static_cast<std::size_t>(mesh.cell_edges[cell * edges.size() + e]) * Dimension;
      add(of_edges.data() + at, slope, of_edge * 0.5 * (window(vertices[a]) + window(vertices[b])));
    }
    for (int i = 0; i <= Dimension; ++i) {
      double product = 0;
      for (int k = 0; k < Dimension; ++k) product += carried[k] * geometry.gradient[i][k];
      load.values[vertices[i]] -= geometry.measure * product;
    }
  }
}

/// ∂t u [m/s^2] at fixed points of space, at the vertices of a cell.
template <int Dimension>
std::array<std::array<double, Dimension>, Dimension + 1> acceleration(const FlowView& flow,
                                                                      std::span<const std::int32_t> vertices,
                                                                      const fem::SimplexGeometry<Dimension>& geometry) {
  const double dt = flow.time_end - flow.time_begin;
  std::array<std::array<double, Dimension>, Dimension> slope = {};  // ∂_l u_k
  std::array<std::array<double, Dimension>, Dimension + 1> result;
  for (int i = 0; i <= Dimension; ++i) {
    for (int k = 0; k < Dimension; ++k) {
      const std::size_t at = static_cast<std::size_t>(vertices[i]) * Dimension + k;
      result[i][k] = (flow.velocity_end[at] - flow.velocity_begin[at]) / dt;
      const double middle = 0.5 * (flow.velocity_begin[at] + flow.velocity_end[at]);
      for (int l = 0; l < Dimension; ++l) slope[k][l] += middle * geometry.gradient[i][l];
    }
  }
  for (int i = 0; i <= Dimension; ++i) {
    const double* beta = flow.mesh_velocity.data() + static_cast<std::size_t>(vertices[i]) * Dimension;
    for (int k = 0; k < Dimension; ++k) {
      for (int l = 0; l < Dimension; ++l) result[i][k] -= beta[l] * slope[k][l];
    }
  }
  return result;
}

template <int Dimension>
void add_acceleration(const FlowView& flow, fem::Load& load) {
  const mesh::Mesh& mesh = *flow.space->mesh;
  for (const mesh::NamedFacet& facet : flow.walls) {
    const auto vertices = mesh.vertices_of(facet.cell);
    if (!flow.cell_is_fluid[facet.cell] || has_silent_vertex(flow, vertices)) continue;
    const auto geometry = geometry_of_cell<Dimension>(flow, vertices);
    const auto rates = acceleration<Dimension>(flow, vertices, geometry);
    std::array<double, Dimension + 1> through = {};  // ∂t u·n times the facet's measure
    double total = 0;
    for (int i = 0; i <= Dimension; ++i) {
      if (i == facet.index) continue;
      // n |facet| = -d |cell| ∇λ of the vertex opposite.
      for (int k = 0; k < Dimension; ++k) {
        through[i] -= Dimension * geometry.measure * geometry.gradient[facet.index][k] * rates[i][k];
      }
      total += through[i];
    }
    for (int i = 0; i <= Dimension; ++i) {
      if (i != facet.index) load.values[vertices[i]] -= (total + through[i]) / (Dimension * (Dimension + 1));
    }
  }
}

}  // namespace

void add_carried_momentum(const FlowView& flow, const AnalogyMedium& medium, CarriedMomentum which,
                          const std::vector<double>& velocity, const std::vector<double>& of_edges, fem::Load& load) {
  if (flow.space->mesh->dimension == 2) {
    add_momentum<2>(flow, medium, which, velocity, of_edges, load);
  } else {
    add_momentum<3>(flow, medium, which, velocity, of_edges, load);
  }
}

void add_wall_acceleration(const FlowView& flow, fem::Load& load) {
  if (flow.space->mesh->dimension == 2) {
    add_acceleration<2>(flow, load);
  } else {
    add_acceleration<3>(flow, load);
  }
}

void add_forces(const FlowView& flow, const AnalogyMedium& medium, CarriedMomentum which,
                const std::vector<double>& velocity, const std::vector<double>& of_edges, fem::Load& load) {
  add_carried_momentum(flow, medium, which, velocity, of_edges, load);
  add_wall_friction(flow, medium, velocity, of_edges, load);
}

AnalogySource force_source(const FlowView& flow, const AnalogyMedium& medium, CarriedMomentum which) {
  AnalogySource result = {fem::Load(*flow.space, 1), {}};
  add_wall_acceleration(flow, result.begin);
  result.end = result.begin;
  add_forces(flow, medium, which, flow.velocity_begin, flow.edges_begin, result.begin);
  add_forces(flow, medium, which, flow.velocity_end, flow.edges_end, result.end);
  return result;
}

}  // namespace vocalis::coupling
