#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/halo.hpp"
#include "core/fem/field.hpp"
#include "transfer/point_search.hpp"

namespace vocalis::transfer {

/// How well points fit into a mesh; the same on every rank.
struct PointsOutside {
  std::int64_t count = 0;                   ///< of points that no cell contains, on all ranks
  double distance = 0;                      ///< [m] of the furthest, from the mesh
  double cells = 0;                         ///< the largest distance over the longest edge of the nearest cell
  std::array<double, 3> point = {0, 0, 0};  ///< [m] the one with that
};

/// P1 functions of a distributed mesh at points that belong to other ranks, the vertices of another mesh say, each mesh
/// with a partition of its own:
///
///   I_jk = φ_k(x_j),    f(x_j) = Σ_k I_jk f_k,    b_k = Σ_j I_jk b_j.
///
/// Weights are found once, from where mesh and points are then. A point that no cell contains is moved to the nearest
/// point of the nearest cell. Either way takes one exchange with the ranks whose cells hold a rank's points.
///
/// The transpose keeps the sum of all b_j to rounding, since weights at a point sum to 1, and where no point lies
/// outside their first moments Σ x_j b_j, too; so the integrals of a smooth source against smooth functions converge
/// with second order in both meshes. Used for the loads of a fine mesh on a mesh that is not finer: on a finer one some
/// vertices would get nothing. (ExaDG's MGTwoLevelTransferNonNested does the same.)
class PointInterpolation {
 public:
  /// A point further outside than the longest edge of the nearest cell has no part in it: it reads 0, and what it
  /// would give is lost. Any rank may have no cells, or no points. Collective.
  ///
  /// points       (points of this rank, dimension) [m]
  /// cell_counts  (owned cells of the mesh) not 0 where the mesh is to be; empty: everywhere
  PointInterpolation(const mesh::Mesh& mesh, std::span<const double> points,
                     std::span<const std::int32_t> cell_counts = {});

  /// f(x_j) of a P1 field of the mesh, ghosts current: (points, components). Collective.
  void evaluate(const fem::Field& field, std::span<double> at_points) const;

  /// b_k from the numbers b_j at points, (points, components), of which ranks may have parts; whole at the owners,
  /// ghosts are 0. The former content of the load is lost. Collective.
  void restrict_to(std::span<const double> at_points, fem::Load& load) const;

  const PointsOutside& outside() const { return outside_; }
  std::size_t num_points() const { return num_points_; }
  /// Throws UserError if a point has no part in it; `rule` says what must lie inside what.
  void require_all(const std::string& rule) const;
  /// (points of this rank) not 0 where the point has a part in it.
  std::vector<std::int32_t> is_held() const;

 private:
  std::vector<HeldPoint> held_;
  std::vector<std::size_t> takers_;  ///< points of this rank that some rank holds
  base::Halo halo_;                  ///< held points are owned, the takers their ghosts
  std::size_t num_points_;
  PointsOutside outside_;
};

}  // namespace vocalis::transfer
