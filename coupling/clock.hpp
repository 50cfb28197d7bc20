#pragma once

namespace vocalis::coupling {

/// Time, step and how the step follows what becomes of it. Depends on nothing but its own history, so that a resumed
/// run takes the same steps.
///
/// Without a tolerance the step is that of the case; it is halved where the flow does not converge, and doubled again
/// after eight accepted steps. With one it adapts to the relative local error e of a second-order scheme, e ~ dt³, by
/// proportional and integral control (Söderlind 2003, ACM Trans. Math. Softw. 29, sec. 3),
///   dt := dt 0.9 (tolerance / e)^(1/3) (e₋ / e)^(1/15),
/// by no less than 0.3 and no more than 1.5 at once, and not at all between 0.85 and 1.2, for a new step costs the flow
/// a new Jacobian. A step with e > 2 tolerance is taken again, unless it is the smallest already.
struct Clock {
  double time = 0;           ///< [s]
  double end = 0;            ///< [s]
  double nominal_step = 0;   ///< dt of the case, where an adaptive step begins [s]
  double smallest_step = 0;  ///< below this the run has failed [s]
  double largest_step = 0;   ///< of an adaptive step [s]
  double tolerance = 0;      ///< relative local error of an adaptive step; 0: the step does not adapt
  long step = 0;             ///< accepted so far
  long rejected = 0;
  int halvings = 0;           ///< a step that does not adapt is nominal_step / 2^halvings
  int accepted_in_a_row = 0;  ///< at this number of halvings, or since an adaptive step was rejected
  int steps_to_wait = 0;      ///< of accepted_in_a_row before an adaptive step may grow again
  double adaptive_step = 0;   ///< [s]; 0: none was chosen yet
  double last_error = 0;      ///< relative local error of the last accepted step; 0: not known

  bool done() const { return end - time <= 1e-9 * nominal_step; }
  /// The next step [s].
  double dt() const;
  bool can_shrink() const;
  /// After a step that did not converge.
  void shrink();
  /// Whether a step with this relative local error (0: not known) must be taken again, see `refine`.
  bool is_too_coarse(double local_error) const;
  void refine(double local_error);
  /// After an accepted step.
  void advance(double dt, double local_error = 0);

 private:
  void adapt(double dt, double local_error);
};

}  // namespace vocalis::coupling
