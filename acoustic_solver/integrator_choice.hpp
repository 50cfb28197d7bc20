#pragma once

#include <string>

#include "acoustic_solver/settings.hpp"

namespace vocalis::acoustic {

/// Which integrator advances the sound, and why.
struct IntegratorChoice {
  Integrator integrator = Integrator::implicit;
  std::string reason;
};

/// What carries sound past the vertices.
struct Convection {
  bool mesh_moves = false, medium_flows = false;
};

/// "explicit: ..."
std::string words(const IntegratorChoice& choice);

/// Sub-steps of at most `longest` that make up dt; 0 if they were too many to count as steps, since a cell has closed.
int count_sub_steps(double dt, double longest);

/// The part of the longest stable step that the explicit integrator takes.
constexpr double kPartOfStableStep = 0.9;

/// By the settings; where they leave it open, by the estimated cost of advancing by dt [s]. Costs are counted, not
/// measured in the run, so that a run can be repeated to the last bit.
///
/// stable_step  longest stable step of the explicit integrator [s], or a bound of it
IntegratorChoice choose_integrator(const AcousticSettings& settings, int dimension, Convection convection, double dt,
                                   double stable_step);

}  // namespace vocalis::acoustic
