#include "fsi_solver/mesh_motion/nonlinear_smoother.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/base/mpi.hpp"
#include "core/la/solve.hpp"
#include "fsi_solver/mesh_motion/mesh_matrix.hpp"
#include "fsi_solver/solution/direct_solver.hpp"

namespace vocalis::fsi {

namespace {

/// The error that is left, as a relative change of the cell that it changes most.
constexpr double tolerance = 1e-9;
/// Linear solves after which a search is given up.
constexpr int largest_iterations = 60;
/// A cell keeps this part of its volume in one step.
constexpr double kept_volume = 0.5;
/// Where only a shorter part of a step can be gone, better factors are tried first.
constexpr double shortest_part = 1.0 / 16;
/// Steps that change cells less than this need not show that they lower the energy: that would drown in round-off.
constexpr double small_step = 1e-4;
/// Solids with some way to go move on after a step that changes the fluid's cells less than this.
constexpr double settled_step = 0.3;
/// Kept factors are renewed when the search would need more steps than this at the rate of the last one: a
/// factorisation costs about as much as twelve.
constexpr double patience = 12;

/// Whether steps that shrink by `rate` take too long to get from `size` to the tolerance.
bool is_slow(double rate, double size) {
  return rate >= 0.5 || std::log(size / tolerance) > -patience * std::log(rate);
}

}  // namespace

NonlinearSmoother::NonlinearSmoother(const Continuum& continuum, const Conditions& conditions, double stiffening)
    : continuum_(continuum),
      energy_(continuum, stiffening),
      layout_(continuum.mesh->comm, {{&continuum.mesh->vertices, continuum.mesh->dimension}}),
      constrained_(constrained_places(continuum, conditions)) {
  const mesh::Mesh& mesh = *continuum.mesh;
  matrix_ = make_mesh_matrix(continuum, layout_, constrained_);
  solver_ = create_repeatable_solver(matrix_->get(), "mesh_smoother_", Reuse::many_solves);
  right_hand_side_ = la::create_vector(mesh.comm, layout_.num_owned());
  solution_ = la::create_vector(mesh.comm, layout_.num_owned());
}

/// Where the search begins, and where the constrained vertices go.
void NonlinearSmoother::begin(const fem::Field& displacement, const fem::Field& start) {
  const int d = continuum_.mesh->dimension;
  now_ = start;
  now_.copy_to_ghosts();
  step_ = fem::Field(*start.space, d);
  if (!(energy_.smallest_volume(now_) > 0)) now_ = step_;
  target_.assign(constrained_.size(), 0.0);
  for (std::size_t i = 0; i < target_.size(); ++i) {
    if (continuum_.vertex_solid[i / d] >= 0) target_[i] = displacement.values[i];
  }
  arrived_ = false;
  settled_ = true;
  last_size_ = 0;
}

void NonlinearSmoother::factor(Factors kind, SmootherReport& report) {
  matrix_->assemble(energy_.hessian(now_, kind == Factors::exact));
  base::check(KSPSetOperators(solver_.get(), matrix_->get(), matrix_->get()));
  factors_ = kind;
  last_size_ = 0;
  ++report.factorisations;
}

/// Newton's step with the present factors, whether there is one; the constrained vertices go all their way if it
/// `pushes`, else they stay.
bool NonlinearSmoother::find_step(bool pushes) {
  const fem::Load gradient = energy_.gradient(now_);
  {
    const la::OwnedValues values(right_hand_side_.get());
    for (std::size_t i = 0; i < constrained_.size(); ++i) {
      const double way = pushes ? target_[i] - now_.values[i] : 0.0;
      values[static_cast<PetscInt>(i)] = constrained_[i] ? way : -gradient.values[i];
    }
  }
  const bool solved = la::solve(solver_.get(), right_hand_side_.get(), solution_.get()).converged;
  double slope = solved ? 0 : std::numeric_limits<double>::quiet_NaN();
  {
    const la::ReadValues values(solution_.get());
    for (std::size_t i = 0; i < constrained_.size(); ++i) {
      step_.values[i] = values[static_cast<PetscInt>(i)];
      slope += constrained_[i] ? 0.0 : gradient.values[i] * step_.values[i];
    }
  }
  step_.copy_to_ghosts();
  slope_ = base::sum(continuum_.mesh->comm, slope);
  return std::isfinite(slope_);
}

/// The displacement when a part of the step is gone.
fem::Field NonlinearSmoother::after(double part) const {
  fem::Field result = now_;
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] += part * step_.values[i];
  return result;
}

/// How much of the step can be gone: every cell keeps enough of its volume, and the energy sinks enough (Armijo) unless
/// the solids work on it.
double NonlinearSmoother::longest_part(bool pushes, const MeshEnergy::Change& whole) const {
  const bool must_sink = !pushes && whole.size > small_step;
  if (must_sink && slope_ >= 0) return 0;
  for (double part = 1; part > 1e-4; part /= 2) {
    const MeshEnergy::Change change = part == 1 ? whole : energy_.change(now_, after(part));
    if (change.volume < kept_volume) continue;
    if (!must_sink || change.energy <= 1e-4 * part * slope_) return part;
  }
  return 0;
}

/// Newton's step climbs where the mesh buckles: it leads back to an equilibrium that has become a saddle. The opposite
/// step leads down, away from it.
MeshEnergy::Change NonlinearSmoother::turn_step() {
  for (double& value : step_.values) value = -value;
  slope_ = -slope_;
  return energy_.change(now_, after(1));
}

/// How often a step that leads away from a saddle can be gone, while the energy sinks, if this part of it can.
double NonlinearSmoother::downhill(double part) const {
  double sunk = energy_.change(now_, after(part)).energy;
  for (double longer = 2 * part; longer <= 64; longer *= 2) {
    const MeshEnergy::Change change = energy_.change(now_, after(longer));
    if (change.volume < kept_volume || change.energy >= sunk) break;
    part = longer;
    sunk = change.energy;
  }
  return part;
}

/// One step. Returns whether the search is over.
bool NonlinearSmoother::iterate(SmootherReport& report) {
  if (factors_ == Factors::none) factor(Factors::exact, report);
  ++report.iterations;
  const bool pushes = !arrived_ && settled_;
  const bool has_step = find_step(pushes);
  MeshEnergy::Change whole = energy_.change(now_, after(1));
  const bool turns = has_step && !pushes && factors_ == Factors::exact && slope_ > 0 && whole.size > small_step;
  if (turns) whole = turn_step();
  const double part = has_step ? longest_part(pushes, whole) : 0;
  if (part < shortest_part && factors_ != Factors::convex) {
    factor(factors_ == Factors::kept ? Factors::exact : Factors::convex, report);
    return false;
  }
  if (part == 0 || (pushes && part < shortest_part)) {
    report.reason = "a cell would be inverted";
    factors_ = Factors::none;
    return true;
  }
  now_ = after(turns ? downhill(part) : part);
  arrived_ = arrived_ || (pushes && part == 1);
  settled_ = part == 1 && !turns && whole.size <= settled_step;
  const Factors used = std::exchange(factors_, Factors::none);
  if (part < 1 || turns || used == Factors::convex) return false;
  // Newton's method squares the error, kept factors shrink it as they did in the step before.
  const double ratio = last_size_ > 0 ? whole.size / last_size_ : 1.0;
  const double error = whole.size * (used == Factors::exact ? whole.size : ratio);
  report.converged = arrived_ && error <= tolerance;
  if (report.converged || last_size_ == 0 || !is_slow(ratio, whole.size)) factors_ = Factors::kept;
  last_size_ = whole.size;
  return report.converged;
}

SmootherReport NonlinearSmoother::extend(fem::Field& displacement, const fem::Field& start) {
  SmootherReport report;
  begin(displacement, start);
  for (bool over = false; !over && report.iterations < largest_iterations;) over = iterate(report);
  if (!report.converged && report.reason.empty()) report.reason = "the iterations ran out";
  const int d = continuum_.mesh->dimension;
  for (std::size_t i = 0; i < constrained_.size(); ++i) {
    if (continuum_.vertex_solid[i / d] < 0) displacement.values[i] = now_.values[i];
  }
  displacement.copy_to_ghosts();
  report.smallest_quality = smallest_fluid_quality(continuum_, displacement);
  return report;
}

}  // namespace vocalis::fsi
