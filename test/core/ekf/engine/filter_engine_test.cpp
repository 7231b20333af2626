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

/// Wheels that drag can be far slower than the rover. Those that nearly stand do not slip: they are wrong, or the
/// state.
TEST(FilterEngine, NoSlipIsThreeTimesTheSpeedOfTheWheels) {
  Config config = driveConfig(20.0);
  config.simulator.terrain = "paved";
  const RecordedDrive drive = recordDrive(config);
  const Nanoseconds begin = drive.initial.nav.stamp + 20 * kSecond;
  const auto largestSlipWith = [&](double slower) {
    std::vector<DriveSample> samples = drive.samples;
    for (DriveSample& sample : samples) {
      sample.wheels.motion.forward_mps /= sample.stamp() > begin ? slower : 1.0;
    }
    double largest = 0.0;
    for (const LoggedEstimate& logged : runNavigator(config, drive.initial, samples)) {
      const Nanoseconds since = logged.estimate.nav.stamp - begin;
      const double slip = std::abs(logged.estimate.vehicle.fast_slip);
      largest = since > 0 && since < kSecond / 2 ? std::max(largest, slip) : largest;
    }
    return largest;
  };
  EXPECT_NEAR(largestSlipWith(2.5), 1.5, 0.3);
  EXPECT_LT(largestSlipWith(4.0), 0.5);
}

/// Means over a shorter way come more often, and are worth less in the same proportion.
TEST(FilterEngine, TheLateralConstraintTellsAsMuchHoweverOftenItIsUsed) {
  const auto sidewaysStd_mps = [](double longest_interval_s) {
    Config config = driveConfig(12.0);
    config.filter.updates = {"wheel", "nonholonomic"};
    config.nonholonomic.max_interval_s = longest_interval_s;
    const RecordedDrive drive = recordDrive(config);
    EstimateLog log = runNavigator(config, drive.initial, drive.samples);
    while (log.back().estimate.motion.v_eb_b.x() < 0.5) {
      log.pop_back();
    }
    const Vector3 aside_n = log.back().estimate.nav.q_b_to_n * Vector3::UnitY();
    return std::sqrt(aside_n.dot(log.back().P.block<3, 3>(kVelocity, kVelocity) * aside_n));
  };
  EXPECT_NEAR(sidewaysStd_mps(0.1) / sidewaysStd_mps(2.0), 1.0, 0.4);
}

/// Only slip that was found unexpectedly is held.
TEST(FilterEngine, PersistentSlipOfTheStartIsForgottenOnTheWay) {
  constexpr double kSlip = 0.3;
  Config config = driveConfig(8.0);
  config.filter.updates = {};
  RecordedDrive drive = recordDrive(config);
  drive.initial.vehicle.slow_slip = kSlip;
  drive.initial.P(kSlowSlip, kSlowSlip) = square(0.01);
  const double left = runNavigator(config, drive.initial, drive.samples).back().estimate.vehicle.slow_slip / kSlip;
  EXPECT_LT(left, 0.9);
  EXPECT_GT(left, std::exp(-20.0 / config.vehicle.slow_slip_length_m));
}

/// A configuration may say that no ground changes on short ways; a wheel slips all the same.
TEST(FilterEngine, AWheelMaySlipWhereNoFastSlipIsConfigured) {
  Config config = driveConfig(12.0);
  config.vehicle.fast_slip_std = 0.0;
  RecordedDrive drive = recordDrive(config);
  const Nanoseconds middle = drive.samples[drive.samples.size() / 2].stamp();
  for (DriveSample& sample : drive.samples) {
    sample.wheels.motion.forward_mps *= sample.stamp() > middle && sample.stamp() < middle + kSecond ? 2.0 : 1.0;
  }
  double largest = 0.0;
  for (const LoggedEstimate& logged : runNavigator(config, drive.initial, drive.samples)) {
    ASSERT_TRUE(logged.P.allFinite());
    largest = std::max(largest, logged.estimate.vehicle.fast_slip);
  }
  EXPECT_GT(largest, 0.3);
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

/// The planet turns the rover; no point of it moves over the ground.
TEST(FilterEngine, ARoverAtRestIsAtRestInEveryPoint) {
  Config config = driveConfig(2.0);
  config.filter.updates = {"wheel"};
  config.imu.mount.x_m = 50.0;
  const InitialState initial = recordDrive(config).initial;
  const Planet planet = Planet::byName(config.planet);
  const Quaternion q_n_to_b = initial.nav.q_b_to_n.conjugate();
  const std::vector<DriveSample> samples = standing(initial.nav.stamp, [&](ImuSample& imu) {
    imu.f_ib_b = -(q_n_to_b * planet.gravity_n(initial.nav.position));
    imu.omega_ib_b = q_n_to_b * planet.omega_ie_n(initial.nav.position.latitude_rad);
  });
  const EstimateLog log = runNavigator(config, initial, samples);
  EXPECT_LT(log[200].estimate.motion.v_eb_b.norm(), 1e-3);
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
