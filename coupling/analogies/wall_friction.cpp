#include "coupling/analogies/wall_friction.hpp"

#include "coupling/analogies/flow_cell.hpp"

namespace vocalis::coupling {

namespace {

template <int Dimension>
using Matrix = std::array<std::array<double, Dimension>, Dimension>;

/// Mean of ∂_l u_k over a facet, taken from its cell: where u is quadratic its value in the facet's middle.
template <int Dimension>
Matrix<Dimension> slope_at_facet(const mesh::Mesh& mesh, const mesh::NamedFacet& facet,
                                 const fem::SimplexGeometry<Dimension>& geometry, const std::vector<double>& velocity,
                                 const std::vector<double>& of_edges) {
  Matrix<Dimension> result = {};
  const auto add = [&](const std::vector<double>& values, std::int32_t dof, const auto& slope) {
    for (int k = 0; k < Dimension; ++k) {
      const double u = values[static_cast<std::size_t>(dof) * Dimension + k];
      for (int l = 0; l < Dimension; ++l) result[k][l] += u * slope[l];
    }
  };
  const auto place = [&](int corner) { return corner == facet.index ? 0.0 : 1.0 / Dimension; };  // barycentric
  const auto vertices = mesh.vertices_of(facet.cell);
  for (int i = 0; i <= Dimension; ++i) {
    std::array<double, Dimension> slope = geometry.gradient[i];
    for (double& component : slope) component *= of_edges.empty() ? 1 : 4 * place(i) - 1;
    add(velocity, vertices[i], slope);
  }
  const auto edges = mesh::edges_of_cell(Dimension);
  for (std::size_t e = 0; !of_edges.empty() && e < edges.size(); ++e) {
    const auto [a, b] = edges[e];
    std::array<double, Dimension> slope;
    for (int l = 0; l < Dimension; ++l) {
      slope[l] = 4 * (place(a) * geometry.gradient[b][l] + place(b) * geometry.gradient[a][l]);
    }
    add(of_edges, mesh.cell_edges[facet.cell * edges.size() + e], slope);
  }
  return result;
}

template <int Dimension>
void add_friction(const FlowView& flow, const AnalogyMedium& medium, const std::vector<double>& velocity,
                  const std::vector<double>& of_edges, fem::Load& load) {
  const mesh::Mesh& mesh = *flow.space->mesh;
  for (const mesh::NamedFacet& facet : flow.walls) {
    const auto vertices = mesh.vertices_of(facet.cell);
    if (!flow.cell_is_fluid[facet.cell] || has_silent_vertex(flow, vertices)) continue;
    const auto geometry = geometry_of_cell<Dimension>(flow, vertices);
    const auto slope = slope_at_facet<Dimension>(mesh, facet, geometry, velocity, of_edges);
    // n |facet| = -d |cell| ∇λ of the vertex opposite.
    const auto& inward = geometry.gradient[facet.index];
    std::array<double, Dimension> along = {};  // (n × ω) |facet|
    for (int k = 0; k < Dimension; ++k) {
      for (int l = 0; l < Dimension; ++l) {
        along[k] -= Dimension * geometry.measure * inward[l] * (slope[l][k] - slope[k][l]);
      }
    }
    double weight = medium.window.empty() ? 1 : 0;
    for (int i = 0; !medium.window.empty() && i <= Dimension; ++i) {
      if (i != facet.index) weight += medium.window[vertices[i]] / Dimension;
    }
    for (int i = 0; i <= Dimension; ++i) {
      double product = 0;
      for (int k = 0; k < Dimension; ++k) product += along[k] * geometry.gradient[i][k];
      load.values[vertices[i]] -= medium.kinematic_viscosity * weight * product;
    }
  }
}

}  // namespace

void add_wall_friction(const FlowView& flow, const AnalogyMedium& medium, const std::vector<double>& velocity,
                       const std::vector<double>& of_edges, fem::Load& load) {
  if (medium.kinematic_viscosity == 0) return;
  if (flow.space->mesh->dimension == 2) {
    add_friction<2>(flow, medium, velocity, of_edges, load);
  } else {
    add_friction<3>(flow, medium, velocity, of_edges, load);
  }
}

}  // namespace vocalis::coupling
