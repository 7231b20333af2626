#include "random_states.h"

#include "slipnav/core/base/rotation.h"

namespace slipnav::test {
namespace {

/// Typical size of each error, so that random covariances are not dominated by one unit.
ErrorVector typicalErrors() {
  ErrorVector size = ErrorVector::Constant(0.02);
  size.segment<3>(kAttitude).setConstant(0.01);
  size.segment<3>(kVelocity).setConstant(0.1);
  size.segment<3>(kPosition).setConstant(1.0);
  size.segment<3>(kAccelBias).setConstant(0.01);
  size.segment<3>(kGyroBias).setConstant(1e-3);
  return size;
}

}  // namespace

NavigationState randomState(sim::RandomStream& random, double speed_mps) {
  NavigationState state;
  state.stamp = 1'600'000'000'000'000'000;
  state.q_b_to_n = quaternionFromRotationVector(2.0 * random.normal3());
  state.v_eb_n = speed_mps * random.normal3();
  state.position = {degToRad(random.uniform(-70.0, 70.0)), random.uniform(-3.0, 3.0), random.uniform(-100.0, 3000.0)};
  state.accel_bias_b = 0.01 * random.normal3();
  state.gyro_bias_b = 0.001 * random.normal3();
  return state;
}

VehicleState randomVehicle(sim::RandomStream& random) {
  const auto ratio = [&random] { return 0.05 * random.normal(); };
  return {ratio(), ratio(), ratio(), ratio(), ratio(), ratio()};
}

ErrorCovariance randomCovariance(sim::RandomStream& random) {
  ErrorCovariance root;
  for (int row = 0; row < kErrorStates; ++row) {
    for (int column = 0; column < kErrorStates; ++column) {
      root(row, column) = random.normal();
    }
  }
  const ErrorCovariance correlated = root * root.transpose() / kErrorStates + 0.1 * ErrorCovariance::Identity();
  const ErrorCovariance scaled = typicalErrors().asDiagonal() * correlated * typicalErrors().asDiagonal();
  return 0.5 * (scaled + scaled.transpose());
}

ErrorVector unitError(int index, double size) {
  ErrorVector error = ErrorVector::Zero();
  error(index) = size;
  return error;
}

bool sameState(const NavigationState& a, const NavigationState& b) {
  return a.stamp == b.stamp && a.q_b_to_n.coeffs() == b.q_b_to_n.coeffs() && a.v_eb_n == b.v_eb_n &&
         a.position.latitude_rad == b.position.latitude_rad && a.position.longitude_rad == b.position.longitude_rad &&
         a.position.height_m == b.position.height_m && a.accel_bias_b == b.accel_bias_b &&
         a.gyro_bias_b == b.gyro_bias_b;
}

}  // namespace slipnav::test
