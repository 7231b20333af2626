/// Starts under satellite positions as they come: outliers, mixed quality, poor receivers, other clocks.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "evaluation/simulated_drive.h"
#include "simulated_start.h"
#include "slipnav/core/ekf/models/gnss_fix.h"
#include "slipnav/core/navigation/initializer.h"

namespace slipnav::test {
namespace {

/// Alters the i-th fix.
using Damage = std::function<void(int, PositionFix&)>;

struct FixStart {
  std::optional<InitialState> initial;
  NavigationState truth;
  std::string progress;
};

FixStart startUnder(const Config& config, const Damage& damage) {
  const Planet planet = Planet::byName(config.planet);
  const NavigationSetup setup = config.navigation();
  const WheelGeometry geometry = config.wheelGeometry();
  Initializer initializer(planet, setup.initialization, setup.imu_input, setup.filter);
  FixStart start;
  NeverStop policy;
  int fixes = 0;
  simulateDrive(config.simulator, planet, policy, [&](const sim::Measurements& m, const sim::TruthState& truth) {
    if (start.initial) {
      return;
    }
    if (m.gps) {
      PositionFix fix = toPositionFix(*m.gps);
      damage(fixes++, fix);
      initializer.push(fix);
    }
    if (m.wheel) {
      initializer.push(toWheelMotion(geometry, *m.wheel));
    }
    initializer.push(m.imu);
    start.initial = initializer.result();
    start.truth = toNavState(truth, planet, config.imu.mount.position_b());
  });
  start.progress = initializer.progress();
  return start;
}

ErrorVector errorOf(const FixStart& start) {
  return errorBetween(Planet::byName("earth"), start.initial->nav, start.truth);
}

void moveEast(double east_m, double std_m, PositionFix& fix) {
  fix.position.longitude_rad += east_m / (6.37e6 * std::cos(fix.position.latitude_rad));
  fix.variance_ned_m2 = Vector3(1.0, 1.0, 4.0) * std_m * std_m;
}

TEST(FixStart, AFixFarOffThatSaysSoCountsLittle) {
  const FixStart start = startUnder(startConfig(3), [](int i, PositionFix& fix) {
    if (i == 70) {
      moveEast(30.0, 15.0, fix);
    }
  });
  ASSERT_TRUE(start.initial) << start.progress;
  EXPECT_LT(errorOf(start).segment<2>(kPosition).norm(), 0.2);
}

TEST(FixStart, AFixFarOffThatDoesNotSaySoCountsLittle) {
  const FixStart start = startUnder(startConfig(3), [](int i, PositionFix& fix) {
    if (i == 70) {
      moveEast(30.0, 0.02, fix);
    }
  });
  ASSERT_TRUE(start.initial) << start.progress;
  EXPECT_LT(errorOf(start).segment<2>(kPosition).norm(), 0.2);
}

TEST(FixStart, OfMixedFixesTheGoodOnesCount) {
  const FixStart start = startUnder(startConfig(3), [](int i, PositionFix& fix) {
    if (i < 60) {
      moveEast(4.0, 3.0, fix);
    }
  });
  ASSERT_TRUE(start.initial) << start.progress;
  EXPECT_LT(errorOf(start).segment<2>(kPosition).norm(), 0.2);
}

/// Such a receiver needs a longer drive, and the start is as uncertain as it is.
TEST(FixStart, AReceiverOfThreeMetersGivesAnHonestStart) {
  constexpr int kStarts = 12;
  double heading = 0.0;
  double horizontal = 0.0;
  for (int seed = 1; seed <= kStarts; ++seed) {
    Config config = startConfig(seed);
    config.simulator.drive.initial_straight_m = 80.0;
    config.simulator.gps.horizontal_noise_m = 3.0;
    config.simulator.gps.vertical_noise_m = 3.0;
    config.simulator.gps.rate_hz = 5.0;
    const FixStart start = startUnder(config, [](int, PositionFix&) {});
    ASSERT_TRUE(start.initial) << start.progress;
    const ErrorVector error = errorOf(start);
    const ErrorCovariance& P = start.initial->P;
    heading += std::pow(error(kAttitude + 2), 2) / P(kAttitude + 2, kAttitude + 2) / kStarts;
    horizontal += std::pow(error(kPosition), 2) / P(kPosition, kPosition) / (2.0 * kStarts);
    horizontal += std::pow(error(kPosition + 1), 2) / P(kPosition + 1, kPosition + 1) / (2.0 * kStarts);
    EXPECT_LT(std::abs(error(kAttitude + 2)), degToRad(12.0));
  }
  EXPECT_LT(heading, 2.5);
  EXPECT_LT(horizontal, 2.5);
}

TEST(FixStart, NamesAReceiverInGpsTime) {
  Config config = startConfig(3);
  config.simulator.drive.initial_rest_s = 25.0;
  config.simulator.drive.initial_straight_m = 40.0;
  const FixStart start = startUnder(config, [](int, PositionFix& fix) { fix.stamp -= 18 * kSecond; });
  EXPECT_FALSE(start.initial);
  EXPECT_NE(start.progress.find("gps/fix is stamped 18.0 s too early relative to wheels and gyro (18 s: GPS time"),
            std::string::npos)
      << start.progress;
}

}  // namespace
}  // namespace slipnav::test
