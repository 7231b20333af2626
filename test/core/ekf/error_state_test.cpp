#include "slipnav/core/ekf/error_state.h"

#include <gtest/gtest.h>

#include <cmath>

#include "random_states.h"
#include "slipnav/core/base/rotation.h"

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

/// However large the error is: δψ and ξ = v̂ − exp[δψ×] v describe it exactly.
TEST(ErrorState, ACorrectionTakesALargeErrorOutWhole) {
  const Planet earth = Planet::byName("earth");
  sim::RandomStream random(4, "states");
  for (int i = 0; i < 20; ++i) {
    const NavigationState truth = randomState(random, 1.0);
    const Vector3 attitude = 0.2 * random.normal3();
    const Vector3 xi = 0.5 * random.normal3();
    NavigationState estimate = truth;
    estimate.q_b_to_n = quaternionFromRotationVector(attitude) * truth.q_b_to_n;
    estimate.v_eb_n = quaternionFromRotationVector(attitude) * truth.v_eb_n + xi;
    ErrorVector error = ErrorVector::Zero();
    error.segment<3>(kAttitude) = attitude;
    error.segment<3>(kVelocity) = xi + attitude.cross(estimate.v_eb_n);
    correct(earth, error, estimate);
    EXPECT_LT(errorBetween(earth, estimate, truth).cwiseAbs().maxCoeff(), 1e-12);
  }
}

/// The first-order part of a correction is the plain difference, and its reset does nothing when there is no error.
TEST(ErrorState, ASmallCorrectionIsThePlainDifference) {
  const Planet earth = Planet::byName("earth");
  sim::RandomStream random(5, "states");
  const NavigationState before = randomState(random, 1.0);
  ErrorVector error = ErrorVector::Zero();
  for (int k = 0; k < kNavStates; ++k) {
    error(k) = 1e-5 * random.normal();
  }
  NavigationState plain = before;
  subtractError(earth, error, plain);
  NavigationState invariant = before;
  correct(earth, error, invariant);
  EXPECT_LT((invariant.v_eb_n - plain.v_eb_n).norm(), 1e-9);
  EXPECT_GT((invariant.v_eb_n - plain.v_eb_n).norm(), 0.0);
  NavigationState same = before;
  const ErrorReset nothing = correct(earth, ErrorVector::Zero(), same);
  EXPECT_LT((nothing.nav - ErrorReset().nav).norm(), 1e-12);
  EXPECT_LT((nothing.accel_bias - Matrix3::Identity()).norm(), 1e-12);
}

/// A turn of everything about the vertical at the point of linearization before becomes one at the point after.
TEST(ErrorState, AResetKeepsTheHeadingUnobservable) {
  const Planet earth = Planet::byName("earth");
  sim::RandomStream random(6, "states");
  NavigationState state = randomState(random, 1.0);
  const NavigationState before = state;
  ErrorVector error = ErrorVector::Zero();
  error.segment<3>(kVelocity) = random.normal3();
  error.segment<3>(kPosition) = random.normal3();
  const ErrorReset reset = correct(earth, error, state);
  const Vector3 down = Vector3::UnitZ();
  const auto turn = [&](const NavigationState& about) {
    Eigen::Matrix<double, 9, 1> direction;
    direction << down, down.cross(about.v_eb_n), down.cross(positionDifference(earth, about.position, before.position));
    return direction;
  };
  EXPECT_LT((reset.nav * turn(before) - turn(state)).norm(), 1e-6);
  EXPECT_GT((turn(before) - turn(state)).norm(), 0.1);
  // The same holds for what is known: P of that direction alone stays of that direction alone.
  ErrorCovariance P = ErrorCovariance::Zero();
  P.topLeftCorner<9, 9>() = turn(before) * turn(before).transpose();
  applyReset(reset, P);
  EXPECT_LT((P.topLeftCorner<9, 9>() - turn(state) * turn(state).transpose()).norm(), 1e-5);
}

/// Tilt and accelerometer bias of a rover at rest that the specific force cannot tell apart, for a tilt of `axis_n`.
ErrorVector hiddenTilt(const Planet& planet, const NavigationState& at, const Vector3& axis_n) {
  const Vector3 f_n(0.0, 0.0, -planet.gravity_n(at.position).z());
  ErrorVector direction = ErrorVector::Zero();
  direction.segment<3>(kAttitude) = axis_n;
  direction.segment<3>(kAccelBias) = -(at.q_b_to_n.conjugate() * f_n.cross(axis_n));
  return direction;
}

/// The estimate moves along what it cannot see: what it does not know there it does not know afterwards either, and no
/// more. Ten steps of a degree each way, on a slope.
TEST(ErrorState, AResetKeepsTiltAndBiasInseparable) {
  const Planet earth = Planet::byName("earth");
  NavigationState state;
  state.position = {degToRad(39.0), 0.0, 200.0};
  state.q_b_to_n = q_b_to_n_fromEuler(0.1, -0.2, 0.7);
  constexpr double kPriorVariance = 1e-4;
  const auto unknown = [&] {
    const ErrorVector north = hiddenTilt(earth, state, Vector3::UnitX());
    const ErrorVector east = hiddenTilt(earth, state, Vector3::UnitY());
    return ErrorCovariance(kPriorVariance * (north * north.transpose() + east * east.transpose()));
  };
  ErrorCovariance P = unknown();
  const ErrorCovariance at_first = P;
  sim::RandomStream random(7, "tilts");
  for (int i = 0; i < 10; ++i) {
    const Vector3 tilt(degToRad(1.0) * random.normal(), degToRad(1.0) * random.normal(), 0.0);
    applyReset(correct(earth, hiddenTilt(earth, state, tilt), state), P);
  }
  EXPECT_GT((at_first - unknown()).norm(), 0.01 * at_first.norm()) << "nothing was to be done";
  EXPECT_LT((P - unknown()).norm(), 0.002 * P.norm());
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
