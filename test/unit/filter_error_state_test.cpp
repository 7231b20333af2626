#include "slipnav/filter/error_state.h"

#include <gtest/gtest.h>

#include <cmath>

#include "random_states.h"
#include "slipnav/math/rotation.h"

namespace slipnav::test {
namespace {

TEST(ErrorState, TakingAnErrorOutIsTheInverseOfComparing) {
  const Planet earth = Planet::byName("earth");
  sim::RandomStream random(1, "states");
  for (int i = 0; i < 20; ++i) {
    const NavigationState truth = randomState(random, 1.0);
    ErrorVector error = ErrorVector::Zero();
    for (int k = 0; k < kNavStates; ++k) {
      error(k) = 0.01 * random.normal();
    }
    NavigationState estimate = truth;
    subtractError(earth, -error, estimate);
    EXPECT_LT((errorBetween(earth, estimate, truth) - error).cwiseAbs().maxCoeff(), 1e-8);
    subtractError(earth, error, estimate);
    EXPECT_LT(errorBetween(earth, estimate, truth).cwiseAbs().maxCoeff(), 1e-7);
  }
}

/// The one sign of the whole code: error = estimate − truth.
TEST(ErrorState, SignsAreEstimateMinusTruth) {
  const Planet earth = Planet::byName("earth");
  NavigationState truth;
  truth.q_b_to_n = q_b_to_n_fromEuler(0.1, -0.2, 0.5);
  truth.position = {degToRad(40.0), degToRad(10.0), 100.0};
  NavigationState estimate = truth;
  estimate.v_eb_n.y() += 0.5;
  estimate.position.latitude_rad += 1e-6;
  estimate.position.longitude_rad -= 1e-6;
  estimate.position.height_m += 3.0;
  estimate.q_b_to_n = quaternionFromRotationVector(Vector3(0.0, 0.0, 1e-3)) * truth.q_b_to_n;
  const ErrorVector error = errorBetween(earth, estimate, truth);
  EXPECT_DOUBLE_EQ(error(kVelocity + 1), 0.5);
  EXPECT_NEAR(error(kPosition), 6.36, 0.01);
  EXPECT_NEAR(error(kPosition + 1), -4.89, 0.01);
  EXPECT_NEAR(error(kPosition + 2), -3.0, 1e-12);  // higher is less down
  // C(estimate) = (I + [δψ×]) C(truth): an estimate that is turned too far to the east has a positive error about down
  EXPECT_NEAR(error(kAttitude + 2), 1e-3, 1e-12);
  EXPECT_GT(eulerFrom_q_b_to_n(estimate.q_b_to_n).z(), eulerFrom_q_b_to_n(truth.q_b_to_n).z());
}

TEST(ErrorState, VehicleErrorsAreSubtractedFieldByField) {
  VehicleState vehicle{0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  ErrorVector error = ErrorVector::Zero();
  error.segment<6>(kWheelScale) << 0.01, 0.02, 0.03, 0.04, 0.05, 0.06;
  subtractError(error, vehicle);
  EXPECT_DOUBLE_EQ(vehicle.wheel_scale, 0.09);
  EXPECT_DOUBLE_EQ(vehicle.slow_slip, 0.18);
  EXPECT_DOUBLE_EQ(vehicle.fast_slip, 0.27);
  EXPECT_DOUBLE_EQ(vehicle.side_slip, 0.36);
  EXPECT_DOUBLE_EQ(vehicle.mount_pitch_rad, 0.45);
  EXPECT_DOUBLE_EQ(vehicle.mount_yaw_rad, 0.54);
}

TEST(ErrorState, PositionsCompareAcrossTheDateLine) {
  const Planet earth = Planet::byName("earth");
  const Vector3 apart = positionDifference(earth, {0.0, -kPi + 1e-7, 0.0}, {0.0, kPi - 1e-7, 0.0});
  EXPECT_NEAR(apart.y(), 2e-7 * earth.equatorialRadius(), 1e-6);
}

TEST(ErrorState, AttitudeStaysAUnitQuaternion) {
  const Planet earth = Planet::byName("earth");
  sim::RandomStream random(3, "states");
  NavigationState state = randomState(random, 1.0);
  for (int i = 0; i < 10000; ++i) {
    subtractError(earth, unitError(kAttitude + i % 3, 0.3), state);
  }
  EXPECT_NEAR(state.q_b_to_n.norm(), 1.0, 1e-15);
}

}  // namespace
}  // namespace slipnav::test
