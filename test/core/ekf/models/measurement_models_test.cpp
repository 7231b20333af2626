/// Signs and noise of the measurement models, in the words of someone who drives the rover.

#include <gtest/gtest.h>

#include <cmath>

#include "core/sensors/imu_mount.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/ekf/kalman_update.h"
#include "slipnav/core/ekf/models/gnss_fix.h"
#include "slipnav/core/ekf/models/nonholonomic.h"
#include "wheel_speed.h"

namespace slipnav::test {
namespace {

constexpr double kSpeed = 0.8;

/// Heads east at 0.8 m/s on level ground.
NavigationState eastbound() {
  NavigationState state;
  state.q_b_to_n = q_b_to_n_fromEuler(0.0, 0.0, 0.5 * kPi);
  state.v_eb_n = Vector3(0.0, kSpeed, 0.0);
  state.position = {degToRad(40.0), 0.0, 0.0};
  return state;
}

VelocityJacobian jacobian(const NavigationState& state) { return bodyVelocityJacobian(state, Vector3::Zero()); }

const BodyMotion kDriving{0.1, Vector3(kSpeed, 0.0, 0.0), Vector3::Zero()};

NavigationState corrected(const Measurement& measurement, const NavigationState& state) {
  ErrorCovariance P = 0.01 * ErrorCovariance::Identity();
  NavigationState result = state;
  subtractError(Planet::byName("earth"), kalmanUpdate(measurement, P).value(), result);
  return result;
}

TEST(MeasurementSigns, AFasterWheelSpeedsTheEstimateUp) {
  const Measurement m = steadyWheelSpeed({}, kSpeed + 0.2, kDriving, eastbound(), {}, Vector3::Zero());
  EXPECT_NEAR(m.residual(0), 0.2, 1e-12);
  EXPECT_GT(corrected(m, eastbound()).v_eb_n.y(), kSpeed);
}

TEST(MeasurementSigns, SlipTakesFromTheWheelsSpeed) {
  VehicleState slipping;
  slipping.slow_slip = 0.1;
  // at 10 % slip the wheels have to turn faster than the rover moves
  const Measurement m = steadyWheelSpeed({}, kSpeed, kDriving, eastbound(), slipping, Vector3::Zero());
  EXPECT_NEAR(m.residual(0), -0.1 * kSpeed, 1e-12);
  // wheels that are faster than the rover are explained by more slip
  ErrorCovariance P = ErrorCovariance::Zero();
  P(kSlowSlip, kSlowSlip) = 0.01;
  VehicleState vehicle;
  const Measurement faster = steadyWheelSpeed({}, kSpeed + 0.2, kDriving, eastbound(), vehicle, Vector3::Zero());
  subtractError(kalmanUpdate(faster, P).value(), vehicle);
  EXPECT_GT(vehicle.slow_slip, 0.05);
}

TEST(MeasurementSigns, WheelsThatTurnLessThanTheGyroRaiseItsBias) {
  BodyMotion turning = kDriving;
  turning.omega_ib_b.z() = 0.2;
  const Measurement m = yawRateMeasurement({}, 0.1, 0.1, turning);
  EXPECT_NEAR(m.residual(0), -0.1, 1e-12);
  EXPECT_GT(corrected(m, eastbound()).gyro_bias_b.z(), 0.0);
}

TEST(MeasurementSigns, ASidewaysVelocityIsTakenBack) {
  NavigationState state = eastbound();
  state.v_eb_n.x() = -0.1;  // south: to the right of an eastbound rover
  const BodyMotion motion{0.1, Vector3(kSpeed, 0.1, 0.0), Vector3::Zero()};
  const Measurement m = lateralMeasurement({}, motion, jacobian(state), {}, 1.0);
  EXPECT_NEAR(m.residual(0), -0.1, 1e-12);
  EXPECT_GT(corrected(m, state).v_eb_n.x(), state.v_eb_n.x());
}

TEST(MeasurementSigns, ASinkingVelocityIsTakenBack) {
  NavigationState state = eastbound();
  state.v_eb_n.z() = 0.1;
  const BodyMotion motion{0.1, Vector3(kSpeed, 0.0, 0.1), Vector3::Zero()};
  const Measurement m = verticalMeasurement({}, motion, jacobian(state), {}, 1.0);
  EXPECT_NEAR(m.residual(0), -0.1, 1e-12);
  EXPECT_LT(corrected(m, state).v_eb_n.z(), 0.1);
}

TEST(MeasurementSigns, ALeverArmSweepsSideways) {
  // the reference point is 1 m ahead of the IMU; a turn to the right sweeps it to the right
  const Vector3 v_b = bodyVelocity(eastbound(), Vector3(0.0, 0.0, 0.1), Vector3(1.0, 0.0, 0.0));
  EXPECT_NEAR((v_b - Vector3(kSpeed, 0.1, 0.0)).norm(), 0.0, 1e-12);
}

TEST(MeasurementSigns, SlipAngleIsPositiveToTheRight) {
  EXPECT_NEAR(slipAngle(Vector3(1.0, 0.1, 0.0), {}), std::atan(0.1), 1e-12);
  VehicleState crooked;
  crooked.mount_yaw_rad = -0.1;  // the IMU's axes are turned to the left: straight ahead seems to go to the right
  EXPECT_NEAR(slipAngle(Vector3(1.0, 0.1, 0.0), crooked), 0.0, 1e-12);
}

TEST(MeasurementSigns, StraightReverseHasNoSlipAngle) {
  EXPECT_NEAR(slipAngle(Vector3(-1.0, 0.0, 0.0), {}), 0.0, 1e-12);
  EXPECT_NEAR(slipAngle(Vector3(-1.0, -0.1, 0.0), {}), std::atan(0.1), 1e-12);
}

TEST(MeasurementNoise, GrowsWithSpeedAndTurns) {
  WheelOdometryParams wheel;
  wheel.speed_std_mps = 0.02;
  wheel.slip_noise_std = 0.1;
  wheel.yaw_rate_std_deg_per_s = 2.0;
  wheel.yaw_rate_scale_std = 0.5;
  BodyMotion motion = kDriving;
  motion.omega_ib_b = Vector3(0.3, 0.4, 0.2);
  const NavigationState state = eastbound();
  EXPECT_NEAR(steadyWheelSpeed(wheel, kSpeed, motion, state, {}, Vector3::Zero()).variance(0),
              0.02 * 0.02 + std::pow(0.1 * kSpeed, 2) * 0.1 / (0.1 * kSpeed), 1e-12);
  wheel.yaw_rate_length_m = 2.0;
  const double heading_rate = std::pow(degToRad(2.0), 2) + 0.1 * 0.1;
  EXPECT_NEAR(yawRateMeasurement(wheel, 0.0, 0.1, motion).variance(0), 20.0 * heading_rate, 1e-12);
  EXPECT_NEAR(yawRateMeasurement(wheel, 0.0, 5.0, motion).variance(0), heading_rate, 1e-12);
  NonholonomicParams ground;
  ground.lateral_std_mps = 0.01;
  ground.lateral_slope_std = 0.02;
  ground.lateral_turn_std_m = 0.3;
  ground.vertical_std_mps = 0.03;
  ground.vertical_slope_std = 0.04;
  ground.vertical_turn_std_m = 0.2;
  const double v_x = motion.v_eb_b.x();
  ASSERT_GT(v_x, 0.1);
  EXPECT_NEAR(lateralMeasurement(ground, motion, jacobian(state), {}, 0.25).variance(0),
              0.25 * (0.01 * 0.01 + std::pow(0.02 * v_x, 2) + 0.06 * 0.06), 1e-12);
  EXPECT_NEAR(verticalMeasurement(ground, motion, jacobian(state), {}, 4.0).variance(0),
              4.0 * (0.03 * 0.03 + std::pow(0.04 * v_x, 2) + 0.1 * 0.1), 1e-12);
}

/// Slip is a ratio of a speed that lags behind: what the rover gains on it slips too, by a ratio that is known as well
/// as the filter knows it.
TEST(MeasurementNoise, CountsTheSlipOfWhatTheRoverIsAheadBy) {
  VehicleState slipping;
  slipping.wheel_scale = 0.01;
  slipping.slow_slip = 0.2;
  slipping.fast_slip = -0.05;
  const auto variance = [&slipping](double slipping_speed_mps, double slip_variance) {
    return forwardSpeedMeasurement({}, {kSpeed, slipping_speed_mps, 0.1, 0.0}, kDriving, jacobian(eastbound()),
                                   slipping, slip_variance, {})
        .variance(0);
  };
  const double ahead_mps = kSpeed - 0.3;
  const WheelOdometryParams wheel;
  const WheelInterval lagging{kSpeed, -0.3, 0.1, 0.0};
  const double others = wheelNoiseVariance(wheel, 0.1, {}) + newSlipVariance(wheel, lagging, {});
  EXPECT_NEAR(variance(-0.3, 0.0), others + std::pow(ahead_mps * 0.16, 2), 1e-12);
  EXPECT_NEAR(variance(0.3, 0.04) - variance(0.3, 0.0), std::pow(ahead_mps * 0.2, 2), 1e-12);
  EXPECT_EQ(variance(kSpeed, 0.04), variance(kSpeed, 0.0)) << "a rover at a steady speed is not ahead";
}

/// Encoders of any rate say the same together: information is a density in time for noise, in way for slip.
TEST(MeasurementNoise, OfManyShortIntervalsIsThatOfALongOne) {
  const auto variance = [](double duration_s) {
    BodyMotion motion = kDriving;
    motion.duration_s = duration_s;
    return forwardSpeedMeasurement({}, {kSpeed, kSpeed, duration_s, 0.0}, motion, jacobian(eastbound()), {}, 0.0, {})
        .variance(0);
  };
  EXPECT_NEAR(variance(0.01) / 100.0, variance(1.0), 1e-12);
}

TEST(MeasurementNoise, ConstraintsOverLittleWayHoldLittleInformation) {
  NonholonomicParams params;
  params.length_m = 2.0;
  EXPECT_EQ(constraintInformation(params, 3.0), 1.0);
  EXPECT_EQ(constraintInformation(params, 0.5), 0.25);
  EXPECT_EQ(constraintInformation(params, 0.12), 0.06);
  EXPECT_EQ(constraintInformation(params, 0.0), 0.05) << "no way is not quite no information";
}

TEST(PositionFixModel, PullsTheImuThroughTheLeverArm) {
  const Planet earth = Planet::byName("earth");
  NavigationState state = eastbound();
  PositionFix fix;
  fix.stamp = state.stamp;
  fix.position = state.position;
  fix.position.height_m = 2.0;
  fix.variance_ned_m2 = Vector3(0.01, 0.02, 0.03);
  // antenna 1 m ahead (east) and 2 m above: the fix should lie there, and lies 1 m west of it
  const Measurement m = positionMeasurement(earth, fix, state, Vector3(1.0, 0.0, -2.0));
  EXPECT_NEAR((m.residual - Vector3(0.0, -1.0, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_LT(corrected(m, state).position.longitude_rad, state.position.longitude_rad);
  EXPECT_EQ(Vector3(m.variance), fix.variance_ned_m2);
}

TEST(PositionFixModel, CarriesTheStateBackToTheFix) {
  const Planet earth = Planet::byName("earth");
  const NavigationState state = eastbound();
  PositionFix fix;
  fix.stamp = state.stamp - 10'000'000;
  fix.position = state.position;
  // 10 ms earlier the rover was 8 mm further west than now
  EXPECT_NEAR(positionMeasurement(earth, fix, state, Vector3::Zero()).residual(1), 0.008, 1e-9);
}

/// Turns left on the spot at 0.5 rad/s, heading east: an antenna 2 m ahead moves north.
TEST(VelocityFixModel, TheAntennaMovesAboutTheImu) {
  const Planet earth = Planet::byName("earth");
  NavigationState state = eastbound();
  state.v_eb_n.setZero();
  VelocityFix fix;
  fix.stamp = state.stamp;
  fix.v_ea_n = Vector3(1.0, 0.0, 0.0);
  const Vector3 turning_left(0.0, 0.0, -0.5);
  const Vector3 ahead(2.0, 0.0, 0.0);
  const Vector3 at_rest_b(0.0, 0.0, -9.8);
  // but for the turn of the planet below the antenna
  EXPECT_LT(velocityMeasurement(earth, fix, state, at_rest_b, turning_left, ahead).residual.norm(), 2e-4);
  EXPECT_NEAR(velocityMeasurement(earth, fix, state, at_rest_b, Vector3::Zero(), ahead).residual.x(), 1.0, 2e-4);
}

/// An antenna that does not turn with respect to the planet does not move, wherever it is.
TEST(VelocityFixModel, ThePlanetsRateIsNoMotion) {
  const Planet earth = Planet::byName("earth");
  NavigationState state = eastbound();
  state.v_eb_n.setZero();
  VelocityFix fix;
  fix.stamp = state.stamp;
  const Vector3 planet_rate_b = state.q_b_to_n.conjugate() * earth.omega_ie_n(state.position.latitude_rad);
  const Vector3 far(1000.0, 2000.0, -3000.0);
  const Measurement m = velocityMeasurement(earth, fix, state, Vector3::Zero(), planet_rate_b, far);
  EXPECT_LT(m.residual.norm(), 1e-12);
}

TEST(VelocityFixModel, CarriesTheVelocityBackToTheFix) {
  const Planet earth = Planet::byName("earth");
  const NavigationState state = eastbound();
  VelocityFix fix;
  fix.stamp = state.stamp - fromSeconds(0.02);
  fix.v_ea_n = state.v_eb_n - Vector3(0.0, 0.01, 0.0);  // 0.5 m/s² ahead for 20 ms
  const Vector3 f_ib_n = Vector3(0.0, 0.5, 0.0) - earth.gravity_n(state.position);
  const Vector3 f_ib_b = state.q_b_to_n.conjugate() * f_ib_n;
  const Measurement m = velocityMeasurement(earth, fix, state, f_ib_b, Vector3::Zero(), Vector3::Zero());
  EXPECT_LT(m.residual.norm(), 1e-12);
}

TEST(VelocityFixModel, AFasterAntennaSpeedsTheEstimateUp) {
  const Planet earth = Planet::byName("earth");
  VelocityFix fix;
  fix.stamp = eastbound().stamp;
  fix.v_ea_n = Vector3(0.0, kSpeed + 0.1, 0.0);
  fix.variance_ned_m2ps2.setConstant(1e-4);
  const Vector3 level(0.0, 0.0, -9.8);
  const Measurement m = velocityMeasurement(earth, fix, eastbound(), level, Vector3::Zero(), Vector3::Zero());
  EXPECT_EQ(m.variance, fix.variance_ned_m2ps2);
  EXPECT_NEAR(corrected(m, eastbound()).v_eb_n.y(), kSpeed + 0.1, 0.002);
}

TEST(PositionFixModel, TakesDegreesFromTheReceiver) {
  GnssFix gnss;
  gnss.stamp = 5;
  gnss.latitude_deg = 90.0;
  gnss.longitude_deg = -180.0;
  gnss.height_m = 12.0;
  gnss.covariance_ned_m2 = Vector3(1.0, 2.0, 3.0).asDiagonal();
  const PositionFix fix = toPositionFix(gnss);
  EXPECT_EQ(fix.stamp, 5);
  EXPECT_DOUBLE_EQ(fix.position.latitude_rad, 0.5 * kPi);
  EXPECT_DOUBLE_EQ(fix.position.longitude_rad, -kPi);
  EXPECT_DOUBLE_EQ(fix.position.height_m, 12.0);
  EXPECT_EQ(fix.variance_ned_m2, Vector3(1.0, 2.0, 3.0));
}

TEST(ImuMount, TurnsIntoForwardRightDown) {
  const Vector3 up(0.0, 0.0, 9.8);
  EXPECT_NEAR((ImuMount({}).toBody(7, up, Vector3::Zero()).f_ib_b - Vector3(0.0, 0.0, -9.8)).norm(), 0.0, 1e-12);
  // URDF yaw of 90° left: the sensor's x axis points to the rover's left
  MountParams left;
  left.yaw_deg = 90.0;
  const ImuSample sample = ImuMount(left).toBody(7, Vector3::UnitX(), Vector3::UnitY());
  EXPECT_EQ(sample.stamp, 7);
  EXPECT_NEAR((sample.f_ib_b - Vector3(0.0, -1.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((sample.omega_ib_b - Vector3(-1.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
  // a sensor with forward-right-down axes is rolled by 180° in base_link
  MountParams frd;
  frd.roll_deg = 180.0;
  const Vector3 v(1.0, 2.0, 3.0);
  EXPECT_NEAR((ImuMount(frd).toBody(0, v, v).f_ib_b - v).norm(), 0.0, 1e-12);
  EXPECT_NEAR((ImuMount(left).toSensor(ImuMount(left).toBody(0, v, v).f_ib_b) - v).norm(), 0.0, 1e-12);
  left.x_m = 1.0;
  left.y_m = 2.0;
  left.z_m = 3.0;
  EXPECT_EQ(left.position_b(), Vector3(1.0, -2.0, -3.0));
}

}  // namespace
}  // namespace slipnav::test
