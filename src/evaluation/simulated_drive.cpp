#include "evaluation/simulated_drive.h"

#include "slipnav/core/ekf/error_state.h"

namespace slipnav {

DriveMoment SimulatedDrive::moment() const {
  const sim::TruthState& truth = rover_.truth();
  return {truth.stamp, truth.standstill, driver_.initializationDriveDone()};
}

VelocityCommand SimulatedDrive::operatorCommand() {
  const sim::Command command = driver_.command(rover_.truth());
  return {{command.forward_mps, 0.0, 0.0}, {0.0, 0.0, command.yaw_rate_radps}};
}

sim::Measurements SimulatedDrive::execute(const VelocityCommand& command) {
  return rover_.step({command.linear_mps.x(), command.angular_radps.z()});
}

void simulateDrive(const sim::SimulatorParams& params, const Planet& planet, StopPolicy& policy,
                   const DriveSink& sink) {
  SimulatedDrive drive(params, planet);
  while (!drive.finished()) {
    const DriveMoment moment = drive.moment();
    const sim::Measurements measurements = drive.execute(policy.command(drive.operatorCommand(), moment));
    sink(measurements, drive.truth());
  }
}

NavigationState toNavState(const sim::TruthState& truth, const Planet& planet, const Vector3& imu_position_b) {
  NavigationState state;
  state.stamp = truth.stamp;
  state.q_b_to_n = truth.q_b_to_n;
  const Vector3 omega_ie_b = truth.q_b_to_n.conjugate() * planet.omega_ie_n(truth.position.latitude_rad);
  state.v_eb_n = truth.v_eb_n + truth.q_b_to_n * (truth.omega_ib_b - omega_ie_b).cross(imu_position_b);
  state.position = truth.position;
  state.accel_bias_b = truth.accel_bias_mps2;
  state.gyro_bias_b = truth.gyro_bias_radps;
  ErrorVector lever = ErrorVector::Zero();
  lever.segment<3>(kPosition) = -(truth.q_b_to_n * imu_position_b);
  subtractError(planet, lever, state);
  return state;
}

}  // namespace slipnav
