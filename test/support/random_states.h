#pragma once
/// Random states and covariances for tests of Jacobians and updates, and comparison of states.

#include "simulation/random.h"
#include "slipnav/core/ekf/error_state.h"

namespace slipnav::test {

/// Any attitude, position within 70° of the equator, speeds of about `speed_mps`, small biases.
NavigationState randomState(sim::RandomStream& random, double speed_mps);

/// Slip, scale and mounting of a few percent.
VehicleState randomVehicle(sim::RandomStream& random);

/// A well-conditioned covariance in the proportions of the error state's units, fully correlated.
ErrorCovariance randomCovariance(sim::RandomStream& random);

/// Error of one direction of the error state, everything else zero.
ErrorVector unitError(int index, double size);

/// Whether two states are equal bit for bit.
bool sameState(const NavigationState& a, const NavigationState& b);

}  // namespace slipnav::test
