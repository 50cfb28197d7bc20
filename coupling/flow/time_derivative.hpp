#pragma once

#include <deque>
#include <vector>

#include "acoustic_solver/settings.hpp"
#include "coupling/flow/flow_snapshot.hpp"

namespace vocalis::coupling {

using acoustic::PressureDerivative;

/// Steps of the flow by which sound lags so that the derivative has snapshots on both sides.
int lag_of(PressureDerivative derivative);

/// Snapshots that it takes to give the derivative at both ends of a step.
int snapshots_for(PressureDerivative derivative);

/// ∂t p|χ [Pa/s] at the vertices and the time of snapshot `at`, of any distances in time:
///
///   bdf2        through it and the two before, second order: at 10 samples a period 12 % too much and 3 degrees late
///   five_point  ½ (p₁ - p₋₁) / (t₁ - t₋₁) + ½ (p₂ - p₋₂) / (t₂ - t₋₂), which is [2 (p₁ - p₋₁) + p₂ - p₋₂] / (8 dt)
///   where
///               steps are equal: second order, without a shift of phase, and blind to the sawtooth p = (-1)^n
///               (Holoborodko 2008, smooth noise-robust differentiators, N = 5)
///
/// Where snapshots are missing at an end, the nearest stand for them. Needs two snapshots.
std::vector<double> pressure_rate(const std::deque<FlowSnapshot>& snapshots, int at, PressureDerivative derivative);

}  // namespace vocalis::coupling
