#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "contact/walls.hpp"
#include "core/fem/space.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"

namespace vocalis::contact {

/// Fluid between walls, cut from a box of unit bricks, and the exact distance from these walls.
struct Scene {
  std::string name;
  std::array<double, 3> size;      ///< of the box; size[2] is left out in the plane
  std::array<int, 3> cells;        ///< of the coarsest box
  std::vector<std::string> walls;  ///< groups of the box
  double (*distance)(int d, const double* x);
  void (*place)(int d, double* x) = [](int, double*) {};                   ///< moves a point of the box to its place
  bool (*is_fluid)(const double* x) = [](const double*) { return true; };  ///< of a point of the box
  double length = 1;                                                       ///< the largest distance
};

struct SceneMesh {
  mesh::Mesh mesh;
  std::vector<char> is_fluid;  ///< (local cells)
  std::vector<mesh::NamedFacet> walls;

  fem::Space space() const {
    std::vector<std::int32_t> label(mesh.num_cells());
    for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) label[cell] = is_fluid[cell] - 1;
    return fem::lagrange(mesh, 1, label);
  }
};

/// Collective.
inline SceneMesh build(const Scene& scene, int dimension, int refinement, MPI_Comm comm = MPI_COMM_WORLD) {
  const int d = dimension;
  std::array<int, 3> cells = scene.cells;
  for (int& count : cells) count *= refinement;
  SceneMesh result;
  mesh::Mesh& mesh = result.mesh =
      mesh::distribute(comm, mesh::box(comm, {scene.size[0], scene.size[1], d == 3 ? scene.size[2] : 0.0}, cells));
  std::vector<std::int32_t> marks(mesh.cells.num_local());
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    std::array<double, 3> middle = {0, 0, 0};
    for (const std::int32_t v : mesh.vertices_of(cell)) {
      for (int k = 0; k < d; ++k) middle[k] += mesh.point(v)[k] / (d + 1);
    }
    marks[cell] = scene.is_fluid(middle.data());
  }
  mesh.cell_halo.copy_to_ghosts(std::span<std::int32_t>(marks));
  result.is_fluid.assign(marks.begin(), marks.end());
  for (std::size_t i = 0; i < mesh.coordinates.size(); i += d) scene.place(d, &mesh.coordinates[i]);
  std::vector<std::int32_t> groups;
  for (const auto& name : scene.walls) groups.push_back(mesh::index_of(mesh.group_names, name));
  result.walls = wall_facets(mesh, result.is_fluid, groups);
  return result;
}

/// Half the width between two discs, or balls, of radius 1 whose gap is 0.5, at the distance `r` from their axis.
inline double half_width_of_discs(double r) { return 0.25 + 1 - std::sqrt(1 - r * r); }

inline const Scene channel_scene = {"channel",
                                    {0.5, 1, 0.5},
                                    {2, 4, 2},
                                    {"bottom", "top"},
                                    [](int, const double* x) { return std::min(x[1], 1 - x[1]); },
                                    [](int, double*) {},
                                    [](const double*) { return true; },
                                    0.5};

inline const Scene discs_scene = {"two discs",
                                  {0.8, 1, 0.8},
                                  {4, 4, 4},
                                  {"bottom", "top"},
                                  [](int d, const double* x) {
                                    const double r = d == 3 ? std::hypot(x[0], x[2]) : x[0];
                                    return std::min(std::hypot(r, x[1] - 1.25), std::hypot(r, x[1] + 1.25)) - 1;
                                  },
                                  [](int d, double* x) {
                                    x[0] -= 0.4;
                                    if (d == 3) x[2] -= 0.4;
                                    x[1] = (2 * x[1] - 1) * half_width_of_discs(d == 3 ? std::hypot(x[0], x[2]) : x[0]);
                                  },
                                  [](const double*) { return true; },
                                  0.4};

/// A square without its quarter x, y > 1/2, with walls all around, along z in space.
inline const Scene l_scene = {"L-shape",
                              {1, 1, 0.25},
                              {4, 4, 1},
                              {"left", "right", "bottom", "top"},
                              [](int, const double* x) {
                                const double block = std::hypot(std::max(0.5 - x[0], 0.0), std::max(0.5 - x[1], 0.0));
                                return std::min({x[0], x[1], 1 - x[0], 1 - x[1], block});
                              },
                              [](int, double*) {},
                              [](const double* x) { return x[0] < 0.5 || x[1] < 0.5; },
                              0.3};

/// Moves each vertex of the L-shape that is on no wall and no open side by up to a fifth of a brick, each its own way.
inline void shake(SceneMesh& built, int refinement) {
  const int d = built.mesh.dimension;
  const double h = 0.25 / refinement;
  for (std::size_t v = 0; v < built.mesh.coordinates.size() / d; ++v) {
    double* x = &built.mesh.coordinates[v * d];
    long brick[3] = {0, 0, 1};
    for (int k = 0; k < d; ++k) brick[k] = std::lround(x[k] / h);
    if (brick[0] % (2 * refinement) == 0 || brick[1] % (2 * refinement) == 0 || brick[2] % refinement == 0) continue;
    for (int k = 0; k < d; ++k)
      x[k] += 0.2 * h * std::sin(1e4 * (brick[0] + 1.7 * brick[1] + 2.3 * brick[2] + 3.1 * k));
  }
}

/// The angle between y = 0 and y = slope x, with its apex, open at x = 1.
template <int kSlopeInTenths>
const Scene wedge_scene = {"wedge",
                           {1, 1, 0.25},
                           {4, 4, 1},
                           {"bottom"},
                           [](int, const double* x) {
                             constexpr double slope = kSlopeInTenths / 10.0;
                             return std::min(x[1], (slope * x[0] - x[1]) / std::hypot(1, slope));
                           },
                           [](int, double* x) { x[1] *= kSlopeInTenths / 10.0; },
                           [](const double* x) { return x[1] < x[0]; },
                           0.23};

/// Twenty times as long as it is wide.
inline const Scene gap_scene = {"thin gap",
                                {1, 0.05, 0.25},
                                {20, 4, 5},
                                {"bottom", "top"},
                                [](int, const double* x) { return std::min(x[1], 0.05 - x[1]); },
                                [](int, double*) {},
                                [](const double*) { return true; },
                                0.025};

}  // namespace vocalis::contact
