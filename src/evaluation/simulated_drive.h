#pragma once
/// A simulated drive in closed loop with a stop policy, interval by interval.

#include <functional>

#include "config/config.h"
#include "core/stopping/stop_policy.h"
#include "simulation/driver.h"
#include "simulation/simulator.h"

namespace slipnav {

/// The simulated rover and its operator. Commands are in body axes, forward-right-down.
class SimulatedDrive {
 public:
  /// Throws std::invalid_argument that names a parameter out of range.
  SimulatedDrive(const sim::SimulatorParams& params, const Planet& planet) : rover_(params, planet), driver_(params) {}

  /// The script is over.
  bool finished() const { return driver_.finished(); }
  DriveMoment moment() const;

  /// The operator's command for the next interval.
  VelocityCommand operatorCommand();
  /// The rover executes a command for one IMU interval. @return what its sensors give
  sim::Measurements execute(const VelocityCommand& command);

  /// The state at the end of the last interval.
  const sim::TruthState& truth() const { return rover_.truth(); }

 private:
  sim::RoverSimulator rover_;
  sim::Driver driver_;
};

/// Called after each IMU interval with the sensor outputs and the truth. A policy that needs
/// the estimates gets them here.
using DriveSink = std::function<void(const sim::Measurements&, const sim::TruthState&)>;

/// Drives until the script is over.
void simulateDrive(const sim::SimulatorParams& params, const Planet& planet, StopPolicy& policy, const DriveSink& sink);

/// The samples of one interval in order of their stamps, as the navigation takes them.
template <class Navigation>
void pushMeasurements(const sim::Measurements& measurements, const WheelGeometry& geometry, Navigation& navigation) {
  if (measurements.gps) {
    navigation.push(toPositionFix(*measurements.gps));
  }
  for (const sim::WheelReading& earlier : measurements.earlier_wheels) {
    navigation.push(toWheelMotion(geometry, earlier.sample));
  }
  if (measurements.wheel) {
    navigation.push(toWheelMotion(geometry, *measurements.wheel));
  }
  navigation.push(measurements.imu);
}

/// Truth as the state of an IMU at `imu_position_b` from base_link.
NavigationState toNavState(const sim::TruthState& truth, const Planet& planet, const Vector3& imu_position_b);

}  // namespace slipnav
