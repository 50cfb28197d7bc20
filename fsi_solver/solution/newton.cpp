#include "fsi_solver/solution/newton.hpp"

#include <cmath>

#include "fsi_solver/solution/direct_solver.hpp"

namespace vocalis::fsi {

namespace {

/// A kept Jacobian is renewed when the solve would need more iterations than this at the rate of the last one: a
/// factorisation costs about as much as four.
constexpr double patience = 15;
/// Iterations that a new Jacobian is given before it is judged: the first, from far away, may make things worse.
constexpr std::size_t trial = 3;
/// An error from which an old Jacobian leads astray: a large rotation of a thin solid, for one.
constexpr double far_away = 0.15;
/// Secants kept with one Jacobian: each costs a product of vectors an iteration.
constexpr int most_secants = 40;
/// SNES would end on the one rank that knows that the gathered solver has failed, and leave the others waiting: it
/// never counts to this, `improve` and `test` tell all of them.
constexpr PetscInt most_linear_failures = 1000000;
/// Beyond this growth of the error the step is given up.
constexpr double hopeless = 1e6;

}  // namespace

Newton::Newton(Assembly& assembly, double tolerance, int largest_iterations, base::Timers& timers)
    : assembly_(assembly),
      timers_(timers),
      tolerance_(tolerance),
      secants_(assembly.layout().comm(), assembly.layout().start(1), most_secants) {
  const la::SystemLayout& layout = assembly.layout();
  unknowns_ = la::create_vector(layout.comm(), layout.num_owned());
  result_ = la::create_vector(layout.comm(), layout.num_owned());
  base::check(SNESCreate(layout.comm(), solver_.put()));
  SNES snes = solver_.get();
  base::check(SNESSetOptionsPrefix(snes, "flow_"));
  base::check(SNESSetType(snes, SNESNEWTONLS));
  SNESLineSearch search = nullptr;
  base::check(SNESGetLineSearch(snes, &search));
  base::check(SNESLineSearchSetType(search, SNESLINESEARCHBASIC));
  base::check(SNESLineSearchSetPreCheck(search, improve, this));
  base::check(SNESSetFunction(snes, result_.get(), residual, this));
  base::check(SNESSetJacobian(snes, assembly.matrix(), assembly.matrix(), jacobian, this));
  base::check(SNESSetConvergenceTest(snes, test, this, nullptr));
  base::check(SNESSetTolerances(snes, 0, 0, 0, largest_iterations, 100000));
  base::check(SNESSetCheckJacobianDomainError(snes, PETSC_FALSE));
  base::check(SNESSetMaxLinearSolveFailures(snes, most_linear_failures));
  KSP linear = nullptr;
  base::check(SNESGetKSP(snes, &linear));
  make_repeatable_solver(linear, assembly.matrix(), "flow_", Reuse::few_solves);
  base::check(SNESSetFromOptions(snes));
}

PetscErrorCode Newton::residual(SNES snes, Vec unknowns, Vec result, void* context) {
  Newton& self = *static_cast<Newton*>(context);
  try {
    const auto scope = self.timers_.scope("flow.assemble");
    self.size_ = self.assembly_.residual(unknowns, result);
    if (self.size_.inverted || !std::isfinite(self.size_.error)) {
      base::check(SNESSetFunctionDomainError(snes));
    }
    return 0;
  } catch (...) {
    self.failure_ = std::current_exception();
    return PETSC_ERR_USER;
  }
}

PetscErrorCode Newton::jacobian(SNES, Vec, Mat, Mat, void* context) {
  Newton& self = *static_cast<Newton*>(context);
  try {
    const std::size_t n = self.errors_.size();
    bool renew = !self.has_jacobian_ || self.errors_.back() > far_away;
    if (n >= 2) {
      const double rate = self.errors_[n - 1] / self.errors_[n - 2];
      const bool is_slow = std::log(self.errors_[n - 1] / self.tolerance_) > -patience * std::log(rate);
      renew = renew || rate > 1 || (is_slow && (self.jacobians_ == 0 || n >= self.last_renewal_ + trial));
    }
    if (!renew) return 0;
    const auto scope = self.timers_.scope("flow.assemble");
    self.assembly_.jacobian();
    self.has_jacobian_ = true;
    self.secants_.clear();
    ++self.jacobians_;
    self.last_renewal_ = n;
    return 0;
  } catch (...) {
    self.failure_ = std::current_exception();
    return PETSC_ERR_USER;
  }
}

PetscErrorCode Newton::improve(SNESLineSearch, Vec, Vec change, PetscBool* changed, void* context) {
  Newton& self = *static_cast<Newton*>(context);
  try {
    PetscReal size = 0;
    base::check(VecNorm(change, NORM_2, &size));
    self.has_step_ = std::isfinite(size);
    if (!self.has_step_) {
      base::check(VecZeroEntries(change));
    } else if (self.errors_.back() > far_away) {
      self.secants_.begin_solve();
    } else {
      self.secants_.improve(change);
    }
    *changed = PETSC_TRUE;
    return 0;
  } catch (...) {
    self.failure_ = std::current_exception();
    return PETSC_ERR_USER;
  }
}

PetscErrorCode Newton::test(SNES, PetscInt, PetscReal, PetscReal, PetscReal, SNESConvergedReason* reason,
                            void* context) {
  Newton& self = *static_cast<Newton*>(context);
  self.errors_.push_back(self.size_.error);
  *reason = SNES_CONVERGED_ITERATING;
  if (!self.has_step_) {
    *reason = SNES_DIVERGED_LINEAR_SOLVE;
  } else if (self.size_.inverted || !std::isfinite(self.size_.error)) {
    *reason = SNES_DIVERGED_FUNCTION_DOMAIN;
  } else if (self.size_.error <= self.tolerance_) {
    *reason = SNES_CONVERGED_FNORM_RELATIVE;
  } else if (self.size_.error > hopeless * self.errors_.front()) {
    *reason = SNES_DIVERGED_DTOL;
  }
  return 0;
}

NewtonReport Newton::solve(const State& state, const Stage& stage) {
  if (std::abs(stage.rate - jacobian_stage_.rate) > 1e-3 * stage.rate) has_jacobian_ = false;
  const bool is_kept = has_jacobian_;
  const NewtonReport first = attempt(state, stage, Start::extrapolated);
  if (first.converged || !(is_kept || first.inverted)) return first;
  // The fault may be that of the old Jacobian, or of an extrapolation that turns a cell over where cells have just
  // closed, and a new attempt is cheaper than two halves of the step.
  NewtonReport second = attempt(state, stage, first.inverted ? Start::present : Start::extrapolated);
  second.iterations += first.iterations;
  second.jacobians += first.jacobians;
  return second;
}

NewtonReport Newton::attempt(const State& state, const Stage& stage, Start start) {
  jacobian_stage_ = stage;
  jacobians_ = 0;
  errors_.clear();
  secants_.begin_solve();
  failure_ = nullptr;
  has_step_ = true;
  {
    const auto scope = timers_.scope("flow.assemble");
    assembly_.begin_step(state, stage, start, unknowns_.get());
  }
  const PetscErrorCode code = SNESSolve(solver_.get(), nullptr, unknowns_.get());
  if (failure_) std::rethrow_exception(failure_);
  base::check(code);
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  base::check(SNESGetConvergedReason(solver_.get(), &reason));
  NewtonReport report;
  report.converged = reason > 0;
  report.iterations = static_cast<int>(errors_.size()) - 1;
  report.jacobians = jacobians_;
  report.residual = size_.error;
  report.inverted = size_.inverted;
  if (!report.converged) {
    report.reason =
        report.inverted ? "a cell would be inverted, " + assembly_.worst_cell() : SNESConvergedReasons[reason];
    has_jacobian_ = false;
  }
  return report;
}

}  // namespace vocalis::fsi
