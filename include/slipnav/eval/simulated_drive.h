#pragma once
/// A simulated drive in closed loop with a stop policy, sample by sample.

#include <functional>

#include "slipnav/config/config.h"
#include "slipnav/sim/driver.h"
#include "slipnav/sim/simulator.h"
#include "slipnav/stop/stop_policy.h"

namespace slipnav {

/// Called after each IMU interval with what the sensors gave and what was really the case.
using DriveSink = std::function<void(const sim::Measurements&, const sim::TruthState&)>;

/// Drives until the script is over. The policy is asked from the end of the initialisation drive on.
void simulateDrive(const sim::SimulatorParams& params, const Planet& planet, StopPolicy& policy, const DriveSink& sink);

/// The samples of one interval in order of their stamps, as the navigation takes them.
template <class Navigation>
void pushMeasurements(const sim::Measurements& measurements, const WheelGeometry& geometry, Navigation& navigation) {
  if (measurements.gps) {
    navigation.push(toPositionFix(*measurements.gps));
  }
  if (measurements.wheel) {
    navigation.push(toWheelMotion(geometry, *measurements.wheel));
  }
  navigation.push(measurements.imu);
}

/// Truth as the state of an IMU at `imu_position_b` from base_link.
NavigationState toNavState(const sim::TruthState& truth, const Planet& planet, const Vector3& imu_position_b);

}  // namespace slipnav
