#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "fsi_solver/settings.hpp"

namespace vocalis::fsi::test {

/// A box (see mesh::box) whose cells are named by where their centre is.
inline mesh::Mesh box_of_regions(std::array<double, 3> size, std::array<int, 3> cells,
                                 const std::vector<std::string>& regions,
                                 const std::function<int(const std::array<double, 3>&)>& region_at,
                                 MPI_Comm comm = MPI_COMM_WORLD) {
  mesh::WholeMesh whole = mesh::box(comm, size, cells);
  const int d = whole.dimension;
  whole.region_names = regions;
  for (std::int64_t cell = 0; cell < whole.num_cells(); ++cell) {
    std::array<double, 3> centre = {0, 0, 0};
    for (int a = 0; a <= d; ++a) {
      for (int k = 0; k < d; ++k)
        centre[k] += whole.coordinates[whole.cell_vertices[cell * (d + 1) + a] * d + k] / (d + 1);
    }
    whole.cell_region[cell] = region_at(centre);
  }
  return mesh::distribute(comm, whole);
}

inline mesh::Mesh box_of(const std::string& region, std::array<double, 3> size, std::array<int, 3> cells) {
  return box_of_regions(size, cells, {region}, [](const std::array<double, 3>&) { return 0; });
}

/// A condition on a side of the box; pressure [Pa].
inline FlowBoundary boundary(const std::string& group, FlowBoundaryKind kind, double pressure = 0) {
  FlowBoundary result;
  result.group = group;
  result.kind = kind;
  result.pressure = pressure;
  return result;
}

}  // namespace vocalis::fsi::test
