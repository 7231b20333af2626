#include "slipnav/core/ekf/engine/filter_engine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/square.h"
#include "recorded_drive.h"
#include "simulation/random.h"

namespace slipnav::test {
namespace {

/// Half a minute on wheels that stand. @param measure fills in what the IMU feels
template <class Measure>
std::vector<DriveSample> standing(Nanoseconds begin, Measure measure) {
  std::vector<DriveSample> samples;
  for (int i = 1; i <= 1500; ++i) {
    DriveSample imu;
    imu.is_imu = true;
    imu.imu.stamp = begin + fromSeconds(0.02 * i);
    measure(imu.imu);
    samples.push_back(imu);
    if (i % 5 == 0) {
      DriveSample wheels;
      wheels.wheels.stamp = imu.imu.stamp;
      samples.push_back(wheels);
    }
  }
  return samples;
}

/// Whoever sends wheel samples is told which ones are of no use.
TEST(FilterEngine, TakesWheelsFromTheInitialStateOn) {
  const RecordedDrive drive = recordDrive(driveConfig(2.0));
  FilterEngine filter(Planet::byName("earth"), driveConfig(2.0).navigation().filter);
  filter.initialize(drive.initial);
  WheelMotion wheels;
  wheels.stamp = drive.initial.nav.stamp;
  EXPECT_TRUE(filter.push(wheels));
  wheels.stamp -= 1;
  EXPECT_FALSE(filter.push(wheels)) << "older than the state";
  wheels.stamp += kSecond;
  wheels.motion.yaw_rate_radps = std::nan("");
  EXPECT_FALSE(filter.push(wheels));
  wheels.motion = {std::nan(""), 0.0, true};
  EXPECT_FALSE(filter.push(wheels));
  wheels.motion.forward_mps = 0.5;
  EXPECT_TRUE(filter.push(wheels));
}

/// A rover on better ground than the filter was started for: persistent slip is as uncertain as the ground lets it be.
TEST(FilterEngine, PersistentSlipIsConditionedOnTheGround) {
  Config config = driveConfig(6.0);
  RecordedDrive drive = recordDrive(config);
  drive.initial.P(kSlowSlip, kSlowSlip) = 0.04;
  const double variance = square(config.vehicle.slow_slip_std);
  double least = drive.initial.P(kSlowSlip, kSlowSlip);
  for (const LoggedEstimate& logged : runNavigator(config, drive.initial, drive.samples)) {
    least = std::min(least, logged.P(kSlowSlip, kSlowSlip));
  }
  EXPECT_LT(least, 2.0 * variance);
  EXPECT_GT(least, 0.2 * variance);
}

/// Slip that has come to stay becomes persistent slip, which gets the variance that explains it.
TEST(FilterEngine, FastSlipThatLastsBecomesSlowSlip) {
  Config config = driveConfig(40.0);
  config.simulator.terrain = "paved";
  RecordedDrive drive = recordDrive(config);
  const Nanoseconds begin = drive.samples[drive.samples.size() / 3].stamp();
  for (DriveSample& sample : drive.samples) {
    if (!sample.is_imu && sample.stamp() > begin) {
      sample.wheels.motion.forward_mps *= 1.6;
    }
  }
  double largest_slow_slip = 0.0;
  for (const LoggedEstimate& logged : runNavigator(config, drive.initial, drive.samples)) {
    EXPECT_GT(logged.P.diagonal().minCoeff(), 0.0);
    largest_slow_slip = std::max(largest_slow_slip, logged.estimate.vehicle.slow_slip);
  }
  EXPECT_GT(largest_slow_slip, 0.2);
}

/// At rest the gyros show their biases, and the rate of the planet.
TEST(FilterEngine, FindsTheBiasesOfGyrosAtRest) {
  Config config = driveConfig(2.0);
  config.filter.updates = {"zupt", "zaru"};
  const InitialState initial = recordDrive(config).initial;
  const Planet planet = Planet::byName(config.planet);
  const Quaternion q_n_to_b = initial.nav.q_b_to_n.conjugate();
  const Vector3 bias_b = initial.nav.gyro_bias_b + Vector3(2e-5, -3e-5, 4e-5);
  sim::RandomStream random(1, "rest");
  const std::vector<DriveSample> samples = standing(initial.nav.stamp, [&](ImuSample& imu) {
    imu.f_ib_b = 1e-3 * random.normal3() - q_n_to_b * planet.gravity_n(initial.nav.position);
    imu.omega_ib_b = bias_b + q_n_to_b * planet.omega_ie_n(initial.nav.position.latitude_rad) + 1e-5 * random.normal3();
  });
  const EstimateLog log = runNavigator(config, initial, samples);
  ASSERT_TRUE(log.back().estimate.stationary);
  for (int axis = 0; axis < 3; ++axis) {
    const double variance = log.back().P(kGyroBias + axis, kGyroBias + axis);
    EXPECT_LT(variance, 0.1 * initial.P(kGyroBias + axis, kGyroBias + axis)) << axis;
    EXPECT_NEAR(log.back().estimate.nav.gyro_bias_b(axis), bias_b(axis), 4.0 * std::sqrt(variance)) << axis;
  }
}

/// An engine shakes a rover that stands: its wheels stand exactly, which says nothing about how they turn.
TEST(FilterEngine, LearnsNothingFromWheelsThatStand) {
  const Config config = driveConfig(2.0);
  const InitialState initial = recordDrive(config).initial;
  const Vector3 gravity_n = Planet::byName(config.planet).gravity_n(initial.nav.position);
  sim::RandomStream random(1, "engine");
  const std::vector<DriveSample> samples = standing(initial.nav.stamp, [&](ImuSample& imu) {
    imu.f_ib_b = random.normal3() - initial.nav.q_b_to_n.conjugate() * gravity_n;
    imu.omega_ib_b = 0.1 * random.normal3();
  });
  const EstimateLog log = runNavigator(config, initial, samples);
  const Estimate& last = log.back().estimate;
  ASSERT_FALSE(last.stationary);
  EXPECT_EQ(last.noise_factors.wheel, NoiseFactors{}.wheel);
  EXPECT_EQ(last.noise_factors.fast_slip, NoiseFactors{}.fast_slip);
}

TEST(FilterEngine, SaysWhatItHasLearned) {
  const Config config = driveConfig(20.0);
  const RecordedDrive drive = recordDrive(config);
  const EstimateLog log = runNavigator(config, drive.initial, drive.samples);
  EXPECT_NE(log.back().estimate.noise_factors.wheel, NoiseFactors{}.wheel);
  EXPECT_NE(log.back().estimate.noise_factors.slow_slip, NoiseFactors{}.slow_slip);
}

}  // namespace
}  // namespace slipnav::test
