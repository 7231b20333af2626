#include "slipnav/core/ekf/models/zero_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/random.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav::test {
namespace {

ZeroMotionParams params() {
  ZeroMotionParams params;
  params.velocity_std_mps = 0.005;
  params.min_velocity_std_mps = 1e-4;
  params.max_velocity_std_mps = 0.02;
  params.adaptation_samples = 50.0;
  params.rate_std_deg_per_h = 0.0;
  return params;
}

/// A rover at rest whose gyros have a bias: zero rate finds the bias, and not the bias with the planet's rate in it.
TEST(ZeroAngularRate, KeepsThePlanetsRateOutOfTheBias) {
  const Planet earth = Planet::byName("earth");
  sim::RandomStream random(1, "rest");
  NavigationState state;
  state.q_b_to_n = q_b_to_n_fromEuler(0.1, -0.2, 2.0);
  state.position = {degToRad(50.0), 0.0, 0.0};
  const Vector3 omega_ie_n = earth.omega_ie_n(state.position.latitude_rad);
  const Vector3 true_bias(1e-4, -2e-4, 5e-5);
  const Vector3 true_rate = state.q_b_to_n.conjugate() * omega_ie_n;
  const double density = 1e-12;
  ErrorCovariance P = ErrorCovariance::Zero();
  P.diagonal().segment<3>(kGyroBias).setConstant(1e-6);
  P.diagonal().segment<3>(kAttitude).setConstant(1e-6);
  for (int i = 0; i < 2000; ++i) {
    const Vector3 measured = true_rate + true_bias + std::sqrt(density / 0.1) * random.normal3();
    const BodyMotion motion{0.1, Vector3::Zero(), measured - state.gyro_bias_b};
    const Measurement m = zeroAngularRateMeasurement(params(), density, motion, state, omega_ie_n);
    subtractError(earth, kalmanUpdate(m, P).value(), state);
  }
  const double least_difference = 0.3 * earth.rotationRate();
  EXPECT_LT((state.gyro_bias_b - true_bias).norm(), 1e-3 * earth.rotationRate() + 4.0 * std::sqrt(density / 200.0));
  EXPECT_GT((state.gyro_bias_b - true_bias - true_rate).norm(), least_difference);
}

TEST(ZeroAngularRate, NoiseIsThatOfTheGyrosOverTheInterval) {
  ZeroMotionParams with_tremor = params();
  with_tremor.rate_std_deg_per_h = 2.0;
  const BodyMotion motion{0.25, Vector3::Zero(), Vector3::Zero()};
  const Measurement m = zeroAngularRateMeasurement(with_tremor, 4e-10, motion, {}, Vector3::Zero());
  const double tremor = degToRad(2.0) / 3600.0;
  EXPECT_NEAR(m.variance(1), 4e-10 / 0.25 + tremor * tremor, 1e-22);
}

TEST(ZeroVelocity, StopsTheEstimate) {
  NavigationState state;
  state.q_b_to_n = q_b_to_n_fromEuler(0.4, -0.3, 2.0);
  state.position.latitude_rad = 0.7;
  state.v_eb_n = Vector3(0.3, -0.2, 0.1);
  const Measurement m = zeroVelocityMeasurement(4e-6, state);
  EXPECT_LT((Vector3(m.residual) + state.q_b_to_n.conjugate() * state.v_eb_n).norm(), 1e-15) << "in body axes";
  EXPECT_EQ(Vector3(m.variance), Vector3::Constant(4e-6));
  ErrorCovariance P = ErrorCovariance::Identity();
  subtractError(Planet::byName("earth"), kalmanUpdate(m, P).value(), state);
  EXPECT_LT(state.v_eb_n.norm(), 1e-5);
}

/// Innovations of a rover that trembles with `sigma` and whose filter predicts the velocity with `predicted_sigma`.
double learned(double sigma, double predicted_sigma, int samples) {
  StandstillNoise tremor(params());
  sim::RandomStream random(2, "tremor");
  for (int i = 0; i < samples; ++i) {
    tremor.learn(std::hypot(sigma, predicted_sigma) * random.normal3(), predicted_sigma * predicted_sigma);
  }
  return std::sqrt(tremor.variance());
}

TEST(StandstillNoise, LearnsHowMuchTheRoverTrembles) {
  EXPECT_DOUBLE_EQ(std::sqrt(StandstillNoise(params()).variance()), 0.005);
  EXPECT_NEAR(learned(0.001, 1e-5, 2000), 0.001, 0.0002);
  EXPECT_NEAR(learned(0.010, 1e-5, 2000), 0.010, 0.0015);
}

TEST(StandstillNoise, IsNotWhatTheFilterDidNotKnow) {
  // innovations that the filter's own uncertainty explains are no tremor
  EXPECT_LT(learned(1e-4, 0.003, 20000), 0.0015);
}

/// One step by hand: half of the innovation is the filter's own, so that a quarter of the gain applies.
TEST(StandstillNoise, LearnsByTheShareThatItExplains) {
  StandstillNoise tremor(params());
  const double start = 0.005 * 0.005;
  const double innovation2 = 4.0 * start;
  tremor.learn(Vector3::Constant(std::sqrt(innovation2)), start);
  EXPECT_NEAR(tremor.variance(), start + 0.25 / 50.0 * (innovation2 - start - start), 1e-15);
}

TEST(StandstillNoise, StaysWithinItsLimits) {
  StandstillNoise tremor(params());
  for (int i = 0; i < 5000; ++i) {
    tremor.learn(Vector3::Zero(), 0.0);
  }
  EXPECT_DOUBLE_EQ(std::sqrt(tremor.variance()), 1e-4);
  for (int i = 0; i < 5000; ++i) {
    tremor.learn(Vector3(5.0, 5.0, 5.0), 0.0);
  }
  EXPECT_NEAR(std::sqrt(tremor.variance()), 0.02, 1e-6);
  tremor.setVariance(1e-6);
  EXPECT_DOUBLE_EQ(tremor.variance(), 1e-6);
}

TEST(StandstillNoise, OneOutlierIsBounded) {
  StandstillNoise tremor(params());
  const double before = tremor.variance();
  tremor.learn(Vector3(100.0, 0.0, 0.0), 0.0);
  EXPECT_LE(tremor.variance() - before, 0.02 * 0.02 / 50.0);
  EXPECT_GT(tremor.variance(), before);
}

TEST(StandstillNoise, KeepsWhatItHasLearnedWithinOtherLimits) {
  StandstillNoise tremor(params());
  tremor.setVariance(1e-6);
  tremor.retune(params());
  EXPECT_DOUBLE_EQ(tremor.variance(), 1e-6);
  ZeroMotionParams higher = params();
  higher.min_velocity_std_mps = 0.01;
  tremor.retune(higher);
  EXPECT_DOUBLE_EQ(tremor.variance(), 1e-4);
}

}  // namespace
}  // namespace slipnav::test
