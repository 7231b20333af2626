/// An estimate that has run away from its wheels restarts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/navigation/navigator.h"
#include "recorded_drive.h"

namespace slipnav::test {
namespace {

constexpr double kAside_mps = 20.0;

Config config() {
  Config config = driveConfig(10.0);
  config.filter.updates = {"wheel"};  // of which none sees a motion to the side
  return config;
}

/// The first instant after the restart.
TEST(Recovery, TakesVelocityFromTheWheelsAndLevelFromGravity) {
  RecordedDrive drive = recordDrive(config());
  const NavigationState truth = drive.initial.nav;
  drive.initial.nav.v_eb_n += drive.initial.nav.q_b_to_n * Vector3(0.0, kAside_mps, 0.0);
  drive.initial.nav.accel_bias_b = Vector3(0.0, 0.0, 0.3);
  const NavigationSetup setup = config().navigation();
  Navigator navigator(Planet::byName("earth"), setup.imu_input, setup.filter);
  navigator.initialize(drive.initial);
  const auto ignore = [](const Estimate&, const ErrorCovariance&) {};
  double fastest_mps = 0.0;
  double variance_before = 0.0;
  for (const DriveSample& sample : drive.samples) {
    if (sample.is_imu) {
      navigator.push(sample.imu, ignore);
    } else {
      navigator.push(sample.wheels, ignore);
      fastest_mps = std::max(fastest_mps, sample.wheels.largest_speed_mps);
    }
    if (navigator.filter().recoveries() > 0) {
      break;
    }
    variance_before = navigator.filter().covariance()(kPosition, kPosition);
  }
  ASSERT_EQ(navigator.filter().recoveries(), 1U);
  const NavigationState& state = navigator.filter().state();
  const ErrorCovariance& P = navigator.filter().covariance();
  EXPECT_LT(state.v_eb_n.norm(), 2.0 * fastest_mps);
  EXPECT_NEAR(state.accel_bias_b.norm(), 0.0, 1e-3);
  EXPECT_NEAR(std::sqrt(P(kVelocity, kVelocity)), fastest_mps, 0.5 * fastest_mps);
  EXPECT_GT(std::sqrt(P(kPosition, kPosition) - variance_before), 0.8 * kAside_mps) << "gone aside for a second";
  const double tilt_rad =
      std::acos(std::min(1.0, (state.q_b_to_n * Vector3::UnitZ()).dot(truth.q_b_to_n * Vector3::UnitZ())));
  EXPECT_LT(tilt_rad, 5.0 * std::sqrt(P(kAttitude, kAttitude)));
  EXPECT_EQ(P, P.transpose());
}

TEST(Recovery, IsNoneInAnOrdinaryDrive) {
  const RecordedDrive drive = recordDrive(driveConfig(10.0));
  const NavigationSetup setup = driveConfig(10.0).navigation();
  Navigator navigator(Planet::byName("earth"), setup.imu_input, setup.filter);
  navigator.initialize(drive.initial);
  const auto ignore = [](const Estimate&, const ErrorCovariance&) {};
  for (const DriveSample& sample : drive.samples) {
    sample.is_imu ? static_cast<void>(navigator.push(sample.imu, ignore))
                  : static_cast<void>(navigator.push(sample.wheels, ignore));
  }
  EXPECT_EQ(navigator.filter().recoveries(), 0U);
}

}  // namespace
}  // namespace slipnav::test
