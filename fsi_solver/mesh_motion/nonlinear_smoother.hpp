#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/la/assembled_matrix.hpp"
#include "fsi_solver/conditions.hpp"
#include "fsi_solver/mesh_motion/mesh_energy.hpp"

namespace vocalis::fsi {

/// How a search for the places of the fluid's vertices ended.
struct SmootherReport {
  bool converged = false;
  int iterations = 0;           ///< linear solves
  int factorisations = 0;       ///< matrices factored for them
  double smallest_quality = 0;  ///< of the fluid's cells (see mesh::quality)
  std::string reason;           ///< empty when converged
};

/// Carries the displacement of the solids into the fluid's mesh where linear elasticity (see MeshMotion) would spoil
/// it: the fluid's vertices go where MeshEnergy is smallest, a quality-weighted neo-Hookean energy that is infinite
/// where a cell is inverted, so that none ever is. For small displacements this is MeshMotion.
///
/// It differs from Degirmenci 2018, eq. (2.7), in two ways. There the mesh creeps in pseudo-time towards the minimum
/// and keeps what it has not yet reached; here each search goes all the way: the mesh depends on where the solids are,
/// not on how they came there, and comes back whenever they do. And there F is measured from a regular cell, so that
/// the mesh leaves its reference even at rest; here from the cell of the reference.
///
/// The energy is not convex, no more than that of any elastic body: when a body has turned by about a right angle in a
/// narrow room, a search from far away may find another minimum beside the one that small steps lead to.
///
/// Newton's method with a line search; factors are kept while they serve.
class NonlinearSmoother {
 public:
  /// The references must outlive this. Collective.
  NonlinearSmoother(const Continuum& continuum, const Conditions& conditions, double stiffening);

  /// displacement  of the vertices: where solids are given (owned ones suffice), elsewhere found; ghosts current on
  ///               exit
  /// start         a displacement of all vertices to begin from, best the last one found; if a cell is inverted there,
  ///               the search begins from the reference
  ///
  /// If the search fails, the fluid's vertices are where it stopped. Collective.
  SmootherReport extend(fem::Field& displacement, const fem::Field& start);

  /// Forgets the factors that the next search would begin with, so that its result depends on its arguments to the last
  /// bit; else to about 1e-9 of a cell.
  void drop_factors() { factors_ = Factors::none; }

 private:
  /// What is factored: nothing; the Hessian of an earlier place; the Hessian here; its convex part here.
  enum class Factors { none, kept, exact, convex };

  void begin(const fem::Field& displacement, const fem::Field& start);
  bool iterate(SmootherReport& report);
  void factor(Factors kind, SmootherReport& report);
  bool find_step(bool pushes);
  MeshEnergy::Change turn_step();
  double downhill(double part) const;
  double longest_part(bool pushes, const MeshEnergy::Change& whole) const;
  fem::Field after(double part) const;

  const Continuum& continuum_;
  MeshEnergy energy_;
  la::SystemLayout layout_;
  std::vector<char> constrained_;  ///< (owned vertices, dimension)
  std::unique_ptr<la::AssembledMatrix> matrix_;
  la::PetscLinearSolver solver_;
  la::PetscVector right_hand_side_, solution_;
  Factors factors_ = Factors::none;

  // Of the search under way:
  fem::Field now_, step_;
  std::vector<double> target_;  ///< (owned vertices, dimension) where the constrained go
  double slope_ = 0;            ///< change of the energy along the step, to first order
  bool arrived_ = false;        ///< the solids
  bool settled_ = true;         ///< the fluid's cells, well enough for the solids to move on
  double last_size_ = 0;        ///< of the last whole step with these factors; 0: none yet
};

}  // namespace vocalis::fsi
