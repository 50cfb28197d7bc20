#pragma once

#include "fsi_solver/continuum.hpp"
#include "fsi_solver/stage.hpp"
#include "fsi_solver/state.hpp"

namespace vocalis::fsi {

/// Root mean square speeds of a velocity over the dofs of the fluid and over those of solids [m/s]. Collective.
std::array<double, 2> speeds(const Continuum& continuum, const fem::Field& velocity);

/// Estimate of what a step's velocity errs, relative to the largest speed so far, the larger of fluid and solids: the
/// difference from an explicit prediction of the same order, times the ratio of the two methods' error constants.
///
///   θ = 1   v_p = v + dt a                                 error dt²/2 v''
///   BDF2    v_p = v + (1 + r) dt a - r² (v - v₋),  r = dt / dt₋
///
/// with a the rate at the end of the last step. 0 while there is no such rate, and with other θ, whose rate stands at
/// another time. Collective.
/// Source: Gresho, Griffiths, Silvester 2008, SIAM J. Sci. Comput. 30, 2018 (the predictor); Gresho, Sani 1998.
double local_error(const Continuum& continuum, const TimeSettings& settings, const Stage& stage, const State& state,
                   const fem::Field& end_velocity);

}  // namespace vocalis::fsi
