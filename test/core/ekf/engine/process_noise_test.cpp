/// Propagation of the covariance: the sparse product, the growth by noise, and steady states.

#include <gtest/gtest.h>

#include <cmath>

#include "random_states.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/ekf/error_dynamics.h"

namespace slipnav::test {
namespace {

constexpr double kHour_s = 3600.0;
constexpr double kStandardGravity = 9.80665;

/// Nothing but what a test sets.
ImuNoiseParams silentImu() {
  ImuNoiseParams imu;
  imu.accel_noise_mps_per_sqrt_h = 1e-9;
  imu.gyro_noise_deg_per_sqrt_h = 1e-9;
  imu.accel_bias_std_ug = 0.0;
  imu.gyro_bias_std_deg_per_h = 0.0;
  imu.accel_bias_walk_ug_per_sqrt_h = 0.0;
  imu.gyro_bias_walk_deg_per_h_per_sqrt_h = 0.0;
  imu.gyro_scale_std_ppm = 0.0;
  return imu;
}

VehicleModelParams distinctVehicle() {
  VehicleModelParams vehicle;
  vehicle.wheel_scale_std = 0.011;
  vehicle.slow_slip_std = 0.12;
  vehicle.slow_slip_length_m = 40.0;
  vehicle.fast_slip_std = 0.08;
  vehicle.fast_slip_length_m = 2.0;
  vehicle.side_slip_std_deg = 3.0;
  vehicle.side_slip_length_m = 15.0;
  vehicle.mount_pitch_std_deg = 0.4;
  vehicle.mount_yaw_std_deg = 0.5;
  return vehicle;
}

/// Without specific force attitude errors do not come back through the velocity (Schuler), and noise adds up alone.
ErrorTransition transitionInFreeFall(const ErrorDynamics& dynamics, double duration_s) {
  NavigationState state;
  state.position = {degToRad(45.0), 0.0, 0.0};
  ErrorTransition t = dynamics.transition(state, state, Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), duration_s);
  GroundStep ground = dynamics.ground();
  ground.way_m = duration_s;  // at 1 m/s
  dynamics.rollOver(ground, t);
  return t;
}

/// P after `duration_s` from P = 0.
ErrorCovariance grown(const ImuNoiseParams& imu, double duration_s, double step_s) {
  const ErrorDynamics dynamics(Planet::byName("earth"), imu, distinctVehicle());
  const ErrorTransition t = transitionInFreeFall(dynamics, step_s);
  ErrorCovariance P = ErrorCovariance::Zero();
  for (int i = 0; i < static_cast<int>(std::lround(duration_s / step_s)); ++i) {
    ErrorDynamics::propagate(t, P);
  }
  return P;
}

TEST(ProcessNoise, PropagationIsTheDenseProduct) {
  const ErrorDynamics dynamics(Planet::byName("earth"), ImuNoiseParams{}, distinctVehicle());
  sim::RandomStream random(1, "propagation");
  for (int i = 0; i < 20; ++i) {
    const NavigationState start = randomState(random, 1.0);
    const NavigationState end = randomState(random, 1.0);
    const ErrorTransition t =
        dynamics.transition(start, end, 10.0 * random.normal3(), random.normal3(), random.normal3(), 0.3);
    ErrorCovariance P = randomCovariance(random);
    const ErrorCovariance half_Q = 0.5 * ErrorCovariance(t.noise.asDiagonal());
    const ErrorCovariance phi = t.matrix();
    const ErrorCovariance expected = phi * (P + half_Q) * phi.transpose() + half_Q;
    ErrorDynamics::propagate(t, P);
    EXPECT_LT((P - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
    EXPECT_TRUE(P == P.transpose());
    // each part that the sparse product treats by itself matters
    EXPECT_GT((phi.block<6, 1>(0, kYawScale)).norm(), 0.01);
    EXPECT_GT((phi.block<6, 2>(kVelocity, kImuOffset)).norm(), 0.01);
  }
}

TEST(ProcessNoise, TheWholeTransitionHoldsItsParts) {
  const ErrorDynamics dynamics(Planet::byName("earth"), ImuNoiseParams{}, distinctVehicle());
  const ErrorCovariance phi = transitionInFreeFall(dynamics, 0.5).matrix();
  EXPECT_DOUBLE_EQ(phi(kAccelBias, kAccelBias), 1.0);
  EXPECT_DOUBLE_EQ(phi(kGyroBias + 2, kGyroBias + 2), 1.0);
  EXPECT_DOUBLE_EQ(phi(kWheelScale, kWheelScale), 1.0);
  EXPECT_DOUBLE_EQ(phi(kYawScale, kYawScale), 1.0);
  EXPECT_NEAR(phi(kSlowSlip, kSlowSlip), std::exp(-0.5 / 40.0), 1e-12);
  EXPECT_NEAR(phi(kFastSlip, kFastSlip), std::exp(-0.5 / 2.0), 1e-12);
  EXPECT_NEAR(phi(kSideSlip, kSideSlip), std::exp(-0.5 / 15.0), 1e-12);
  EXPECT_EQ((phi.bottomLeftCorner<kErrorStates - 9, 9>()).norm(), 0.0);
}

/// 0.1 °/√h is 0.1° after an hour, whatever the step: a density that is multiplied by dt twice, or not at all, is not.
TEST(ProcessNoise, AngleRandomWalkIsThatOfTheDataSheet) {
  ImuNoiseParams imu = silentImu();
  imu.gyro_noise_deg_per_sqrt_h = 0.1;
  for (const double step_s : {0.02, 0.1}) {
    const ErrorCovariance P = grown(imu, kHour_s, step_s);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(radToDeg(std::sqrt(P(kAttitude + axis, kAttitude + axis))), 0.1, 1e-4);
    }
  }
}

TEST(ProcessNoise, VelocityRandomWalkIsThatOfTheDataSheet) {
  ImuNoiseParams imu = silentImu();
  imu.accel_noise_mps_per_sqrt_h = 0.008;
  for (const double step_s : {0.02, 0.1}) {
    EXPECT_NEAR(std::sqrt(grown(imu, 36.0, step_s)(kVelocity, kVelocity)), 0.0008, 1e-6);
    EXPECT_NEAR(std::sqrt(grown(imu, 36.0, step_s)(kVelocity + 2, kVelocity + 2)), 0.0008, 1e-6);
    // ∫∫ of white noise: σ_p² = q t³/3
    EXPECT_NEAR(std::sqrt(grown(imu, 36.0, step_s)(kPosition, kPosition)), 0.0008 * 36.0 / std::sqrt(3.0), 1e-4);
  }
}

TEST(ProcessNoise, BiasWalksAreThoseOfTheDataSheet) {
  ImuNoiseParams imu = silentImu();
  imu.accel_bias_walk_ug_per_sqrt_h = 100.0;
  imu.gyro_bias_walk_deg_per_h_per_sqrt_h = 3.5;
  const ErrorCovariance P = grown(imu, kHour_s, 0.1);
  EXPECT_NEAR(std::sqrt(P(kAccelBias, kAccelBias)), 100e-6 * kStandardGravity, 1e-9);
  EXPECT_NEAR(std::sqrt(P(kGyroBias + 1, kGyroBias + 1)), degToRad(3.5) / kHour_s, 1e-10);
}

TEST(ProcessNoise, PriorsAreSquaresOfTheGivenDeviations) {
  ImuNoiseParams imu = silentImu();
  imu.accel_bias_std_ug = 1500.0;
  imu.gyro_bias_std_deg_per_h = 250.0;
  imu.gyro_scale_std_ppm = 300.0;
  const ErrorVector prior = ErrorDynamics(Planet::byName("earth"), imu, distinctVehicle()).priorVariance();
  EXPECT_EQ(prior.head<9>().norm(), 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(std::sqrt(prior(kAccelBias + axis)), 1500e-6 * kStandardGravity, 1e-15);
    EXPECT_NEAR(std::sqrt(prior(kGyroBias + axis)), degToRad(250.0) / kHour_s, 1e-15);
  }
  EXPECT_NEAR(std::sqrt(prior(kWheelScale)), 0.011, 1e-15);
  EXPECT_NEAR(std::sqrt(prior(kSlowSlip)), 0.12, 1e-15);
  EXPECT_NEAR(std::sqrt(prior(kFastSlip)), 0.08, 1e-15);
  EXPECT_NEAR(std::sqrt(prior(kSideSlip)), std::tan(degToRad(3.0)), 1e-15);
  EXPECT_NEAR(std::sqrt(prior(kMountPitch)), degToRad(0.4), 1e-15);
  EXPECT_NEAR(std::sqrt(prior(kMountYaw)), degToRad(0.5), 1e-15);
  EXPECT_NEAR(std::sqrt(prior(kYawScale)), 300e-6, 1e-15);
}

/// A Gauss–Markov state comes to its own variance from nothing, and stays there.
TEST(ProcessNoise, GaussMarkovStatesReachTheirSteadyState) {
  const ErrorDynamics dynamics(Planet::byName("earth"), silentImu(), distinctVehicle());
  const ErrorVector prior = dynamics.priorVariance();
  for (const double step_s : {0.02, 0.1}) {
    const ErrorTransition t = transitionInFreeFall(dynamics, step_s);
    ErrorCovariance from_nothing = ErrorCovariance::Zero();
    ErrorCovariance from_prior = prior.asDiagonal();
    const int steps = static_cast<int>(8.0 * 40.0 / step_s);
    for (int i = 0; i < steps; ++i) {
      ErrorDynamics::propagate(t, from_nothing);
      ErrorDynamics::propagate(t, from_prior);
    }
    for (const int index : {kSlowSlip, kFastSlip, kSideSlip}) {
      EXPECT_NEAR(from_nothing(index, index) / prior(index), 1.0, 2e-3) << index;
      EXPECT_NEAR(from_prior(index, index) / prior(index), 1.0, 2e-3) << index;
    }
    EXPECT_EQ(from_nothing(kWheelScale, kWheelScale), 0.0);
    EXPECT_DOUBLE_EQ(from_prior(kMountYaw, kMountYaw), prior(kMountYaw));
  }
}

TEST(ProcessNoise, EstimatesOfGaussMarkovStatesFade) {
  const ErrorDynamics dynamics(Planet::byName("earth"), silentImu(), distinctVehicle());
  const ErrorTransition t = transitionInFreeFall(dynamics, 0.02);
  VehicleState vehicle{0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
  for (int i = 0; i < 500; ++i) {
    ErrorDynamics::decay(t, vehicle);
  }
  EXPECT_NEAR(vehicle.slow_slip, 0.5 * std::exp(-10.0 / 40.0), 1e-6);
  EXPECT_NEAR(vehicle.fast_slip, 0.5 * std::exp(-10.0 / 2.0), 1e-6);
  EXPECT_NEAR(vehicle.side_slip, 0.5 * std::exp(-10.0 / 15.0), 1e-6);
  EXPECT_EQ(vehicle.wheel_scale, 0.5);
  EXPECT_EQ(vehicle.mount_pitch_rad, 0.5);
  EXPECT_EQ(vehicle.mount_yaw_rad, 0.5);
}

/// Slip belongs to the ground: a rover at rest keeps it, and what it knows of it.
TEST(ProcessNoise, SlipStaysWhileTheRoverStands) {
  const ErrorDynamics dynamics(Planet::byName("earth"), silentImu(), distinctVehicle());
  ErrorTransition t = dynamics.transition({}, {}, Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), 10.0);
  dynamics.rollOver(dynamics.ground(), t);
  VehicleState vehicle{0.0, 0.3, 0.2, 0.1, 0.0, 0.0};
  ErrorDynamics::decay(t, vehicle);
  EXPECT_EQ(vehicle.slow_slip, 0.3);
  EXPECT_EQ(vehicle.fast_slip, 0.2);
  EXPECT_EQ(t.noise(kSlowSlip), 0.0);
  EXPECT_EQ(t.noise(kSideSlip), 0.0);
}

}  // namespace
}  // namespace slipnav::test
