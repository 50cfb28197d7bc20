#include "coupling/monitors/probe.hpp"

#include <algorithm>

#include "core/base/mpi.hpp"
#include "core/mesh/locate.hpp"

namespace vocalis::coupling {

namespace {

constexpr double forgiven_outside = 0.1;  // of a cell, in barycentric coordinates
constexpr double worth_a_look = 0.5;      // the same, as if the cell were straight

double lowest(const fem::Barycentric& coordinates, int dimension) {
  return *std::min_element(coordinates.begin(), coordinates.begin() + dimension + 1);
}

}  // namespace

Probe find_probe(const fem::Space& space, std::span<const double> points, const fem::Point& position,
                 const std::vector<std::int32_t>& cell_is_marked) {
  const mesh::Mesh& mesh = *space.mesh;
  Probe best;
  double depth = -forgiven_outside;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (!cell_is_marked[cell]) continue;
    if (lowest(mesh::barycentric_coordinates(mesh, cell, position), mesh.dimension) < -worth_a_look) continue;
    const auto coordinates = fem::CellMap(space, points, cell).coordinates_of(position);
    if (!coordinates || lowest(*coordinates, mesh.dimension) <= depth) continue;
    depth = lowest(*coordinates, mesh.dimension);
    best.cell = cell;
    best.coordinates = *coordinates;
  }
  const auto depths = base::gather_all(mesh.comm, best.cell >= 0 ? depth : -1.0);
  const auto deepest = std::max_element(depths.begin(), depths.end());
  if (*deepest > -1.0) best.rank = static_cast<int>(deepest - depths.begin());
  return best;
}

std::vector<double> value_at(const fem::Field& field, const Probe& probe) {
  const MPI_Comm comm = field.space->mesh->comm;
  std::vector<double> result;
  if (base::rank(comm) == probe.rank) {
    for (int c = 0; c < field.components; ++c) result.push_back(fem::value_in(field, probe.cell, probe.coordinates, c));
  }
  base::broadcast(comm, result, probe.rank);
  return result;
}

}  // namespace vocalis::coupling
