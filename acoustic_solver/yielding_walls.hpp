#pragma once

#include <span>
#include <vector>

#include "acoustic_solver/state.hpp"
#include "acoustic_solver/wave_operator.hpp"

namespace vocalis::acoustic {

/// Walls that move under the pressure, each vertex for itself: w and ẇ of each branch of `WallBranch` are P1 on the
/// facets of a wall, and <ẇ, q> joins the wave equation. At the stage ẇ = y (p + (m / (θ dt)) ẇ* - k w*) with
/// y = 1 / (m / (θ dt) + b + k θ dt), so that the system gets an admittance y and stays symmetric and positive definite
/// (`WaveOperator::system_values`), and with a spectral radius of 1 the energy of air and walls changes by what b takes
/// and no more.
///
/// Each rank keeps the motion at all vertices of its facets, ghosts alike: it follows from p there without a word to
/// the others. Arrays have one number a local vertex, ghosts current.
class YieldingWalls {
 public:
  /// `wave` must outlive the walls.
  YieldingWalls(const mesh::Mesh& mesh, const WaveOperator& wave);

  bool exist() const { return !walls_.empty(); }

  /// Gives the motion its size, and puts the walls at rest where it has another one.
  void prepare(Unknowns& unknowns) const;

  /// The motion of all walls at the vertices, (vertices, `numbers_a_vertex`), ghosts current, 0 off the walls; and
  /// back. For vertices that get other numbers. The first is collective.
  std::vector<double> motion_of_vertices(const Unknowns& unknowns) const;
  void take_motion(std::span<const double> of_vertices, Unknowns& unknowns) const;
  int numbers_a_vertex() const;

  /// Adds -<ẇ, q> of the stage, where `pressure` is given and w follows from its value at the beginning.
  /// beta = θ dt [s], see GeneralisedAlpha. Sums over this rank's facets: the caller adds them to the owners.
  void add_forces(double beta, std::span<const double> pressure, const Unknowns& beginning,
                  std::span<double> sums) const;

  /// u·n at the stage [m/s]: a number a local vertex for each boundary that yields, empty for others.
  std::vector<std::vector<double>> velocities(double beta, std::span<const double> pressure,
                                              const Unknowns& beginning) const;

  /// Moves the walls on to the stage, where p is given.
  void advance(double beta, std::span<const double> pressure, Unknowns& unknowns) const;

  /// ½ <m ẇ, ẇ> + ½ <k w, w> over all ranks [J; J/m in two dimensions]. Collective.
  double energy(const Unknowns& unknowns) const;

 private:
  /// A boundary that yields. Its motion begins at `first` of the state's and is (branches, vertices, 2): ẇ and w.
  struct Wall {
    std::size_t boundary = 0;
    std::size_t first = 0;
    std::vector<std::int32_t> vertices;  ///< local, rising
    std::vector<WallBranch> branches;
  };
  /// ẇ of a branch at the stage.
  static double branch_velocity(const WallBranch& branch, double beta, double pressure, const double* motion);
  /// Calls function(facet, corners, count) with the local vertices of each of this rank's facets of a yielding wall.
  template <class Function>
  void for_each_facet(const Function& function) const;

  const mesh::Mesh* mesh_;
  const WaveOperator* wave_;
  std::vector<Wall> walls_;
  std::size_t num_numbers_ = 0;  ///< of the motion
};

}  // namespace vocalis::acoustic
