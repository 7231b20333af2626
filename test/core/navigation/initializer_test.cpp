#include "slipnav/core/navigation/initializer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/simulated_drive.h"
#include "random_states.h"
#include "simulated_start.h"
#include "simulation/simulator.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/ekf/models/gnss_fix.h"

namespace slipnav::test {
namespace {

TEST(Initializer, RestAndDriveGiveTheHeading) {
  for (int seed = 1; seed <= 5; ++seed) {
    const Start start = initialize(startConfig(seed));
    ASSERT_TRUE(start.initial) << start.progress;
    ASSERT_EQ(start.truth.stamp, start.initial->nav.stamp);
    EXPECT_LT(sigmas(start, kAttitude + 2), 3.5) << seed;
    EXPECT_LT(radToDeg(std::sqrt(start.initial->P(kAttitude + 2, kAttitude + 2))), 2.0);
    EXPECT_LT(std::abs(errorOf(start)(kAttitude + 2)), degToRad(3.0));
    EXPECT_LT(errorOf(start).segment<3>(kPosition).norm(), 0.2);
  }
}

/// The map begins at the IMU, not at the antenna.
TEST(Initializer, AntennaLeverArmIsTakenOut) {
  Config config = startConfig(2);
  config.simulator.gps.antenna_x_m = -0.6;
  config.simulator.gps.antenna_y_m = 0.8;
  config.simulator.gps.antenna_z_m = -1.5;
  config.gps_mount.x_m = -0.6;
  config.gps_mount.y_m = -0.8;
  config.gps_mount.z_m = 1.5;
  const Start start = initialize(config);
  ASSERT_TRUE(start.initial) << start.progress;
  EXPECT_LT(errorOf(start).segment<3>(kPosition).norm(), 0.1);
  const Geodetic true_origin{degToRad(config.simulator.start_latitude_deg),
                             degToRad(config.simulator.start_longitude_deg), config.simulator.start_height_m};
  EXPECT_LT(positionDifference(Planet::byName("earth"), start.initial->origin, true_origin).norm(), 0.1);
}

TEST(Initializer, SaysWhatItIsWaitingFor) {
  const Start start = initialize(startConfig(1));
  const std::vector<std::string> expected = {"waiting for a standstill of 5 s", "at rest: ready for the straight drive",
                                             "straight drive under gps/fix"};
  EXPECT_EQ(start.said, expected);
  Interference no_fixes;
  no_fixes.no_fixes_from_s = 0.0;
  const Start blind = initialize(startConfig(1), no_fixes);
  EXPECT_FALSE(blind.initial);
  EXPECT_EQ(blind.progress, "waiting for gps/fix");
}

TEST(Initializer, SaysThatFixesHaveStopped) {
  Interference outage;
  outage.no_fixes_from_s = 14.0;
  outage.no_fixes_until_s = 19.0;
  const Start start = initialize(startConfig(1), outage);
  const std::vector<std::string> expected = {"waiting for a standstill of 5 s", "at rest: ready for the straight drive",
                                             "straight drive under gps/fix", "gps/fix silent",
                                             "straight drive under gps/fix"};
  EXPECT_EQ(start.said, expected);
  ASSERT_TRUE(start.initial);
  EXPECT_LT(sigmas(start, kAttitude + 2), 3.5);
}

/// Positions that are a meter off say little about the course over ten; velocities say it within a degree.
TEST(Initializer, SatelliteVelocitiesHelpPoorPositions) {
  constexpr int kStarts = 10;
  double without = 0.0;
  double with = 0.0;
  for (int seed = 1; seed <= kStarts; ++seed) {
    Config config = startConfig(seed);
    config.simulator.gps.horizontal_noise_m = 1.0;
    config.simulator.gps.vertical_noise_m = 2.0;
    const Start poor = initialize(config);
    Interference interference;
    interference.velocity_std_mps = 0.05;
    const Start helped = initialize(config, interference);
    ASSERT_TRUE(poor.initial) << poor.progress;
    ASSERT_TRUE(helped.initial) << helped.progress;
    for (const int index : {kAttitude + 2, static_cast<int>(kVelocity), kVelocity + 1, kVelocity + 2}) {
      EXPECT_LT(sigmas(helped, index), 4.0) << "seed " << seed << ", state " << index;
    }
    without += std::pow(errorOf(poor)(kAttitude + 2), 2) / kStarts;
    with += std::pow(errorOf(helped)(kAttitude + 2), 2) / kStarts;
  }
  EXPECT_LT(std::sqrt(with), degToRad(1.0));
  EXPECT_LT(std::sqrt(with), 0.5 * std::sqrt(without));
}

/// Samples begin when the rover has started already: the heading comes from the drive, the level from the move.
TEST(Initializer, WithoutRestItLevelsOnTheMove) {
  Config config = startConfig(3);
  config.simulator.drive.initial_straight_m = 20.0;
  Interference late;
  late.ignore_before_s = 14.0;
  const Start start = initialize(config, late);
  ASSERT_TRUE(start.initial) << start.progress;
  EXPECT_LT(sigmas(start, kAttitude + 2), 3.5);
  EXPECT_LT(sigmas(start, kAttitude), 3.5);
  EXPECT_LT(sigmas(start, kAttitude + 1), 3.5);
  EXPECT_LT(errorOf(start).segment<3>(kPosition).norm(), 0.3);
}

TEST(Initializer, GivenPoseIsTakenAndLeveled) {
  Config config = startConfig(4);
  config.initialization.source = "given";
  config.initialization.heading_deg = 123.0;
  config.initialization.heading_std_deg = 2.0;
  config.initialization.latitude_deg = 40.0;
  config.initialization.longitude_deg = -80.0;
  config.initialization.height_m = 222.0;
  config.initialization.position_std_m = 0.5;
  config.initialization.leveling_window_s = 5.0;
  const Start start = initialize(config);
  ASSERT_TRUE(start.initial);
  const InitialState& initial = *start.initial;
  const Vector3 euler = eulerFrom_q_b_to_n(initial.nav.q_b_to_n);
  const Vector3 truth = eulerFrom_q_b_to_n(start.truth.q_b_to_n);
  EXPECT_NEAR(euler.z(), degToRad(123.0), 1e-9);
  EXPECT_NEAR(euler.x(), truth.x(), 0.006);
  EXPECT_NEAR(euler.y(), truth.y(), 0.006);
  EXPECT_DOUBLE_EQ(radToDeg(initial.nav.position.latitude_rad), 40.0);
  EXPECT_DOUBLE_EQ(initial.nav.position.height_m, 222.0);
  EXPECT_EQ(initial.origin.latitude_rad, initial.nav.position.latitude_rad) << "the map begins where the rover is";
  EXPECT_EQ(initial.origin.longitude_rad, initial.nav.position.longitude_rad);
  EXPECT_EQ(initial.origin.height_m, 222.0);
  EXPECT_EQ(initial.nav.v_eb_n.norm(), 0.0);
  EXPECT_NEAR(initial.P(kAttitude + 2, kAttitude + 2), std::pow(degToRad(2.0), 2), 1e-12);
  EXPECT_NEAR(initial.P(kPosition, kPosition), 0.25, 1e-12);
}

/// A rest is seen late: once the wheels have rested for a while, and their next sample has come.
TEST(Initializer, RestIsSeenAlsoWhenWheelsAreSlow) {
  Config config;
  config.initialization.source = "given";
  config.initialization.leveling_window_s = 5.0;
  const auto isAtRest = [&config](int imu_per_wheels, double rolling_s) {
    const NavigationSetup setup = config.navigation();
    Initializer initializer(Planet::byName("earth"), setup.initialization, setup.imu_input, setup.filter);
    for (int i = 0; i <= 500; ++i) {
      WheelMotion wheels;
      wheels.stamp = fromSeconds(1000.0 + 0.01 * i);
      wheels.motion.forward_mps = wheels.largest_speed_mps = 0.01 * i < rolling_s ? 0.3 : 0.0;
      if (i % imu_per_wheels == 0) {
        initializer.push(wheels);
      }
      initializer.push(ImuSample{wheels.stamp, Vector3(0.0, 0.0, -9.8), Vector3::Zero()});
    }
    return initializer.result().value().P(kVelocity, kVelocity) < std::pow(0.1, 2);
  };
  EXPECT_TRUE(isAtRest(100, 0.0));
  EXPECT_FALSE(isAtRest(40, 0.5)) << "it has rolled for a while";
}

TEST(Initializer, MotionStartsWhileDriving) {
  Config config = startConfig(5);
  config.simulator.drive.initial_straight_m = 20.0;
  config.initialization.source = "motion";
  config.initialization.leveling_window_s = 5.0;
  Interference late;
  late.ignore_before_s = 15.0;
  const Start start = initialize(config, late);
  ASSERT_TRUE(start.initial);
  // forward speed along the given heading, roll and pitch near the truth
  const Vector3 v_b = start.initial->nav.q_b_to_n.conjugate() * start.initial->nav.v_eb_n;
  EXPECT_NEAR(v_b.x(), start.truth.v_eb_n.norm(), 0.1);
  EXPECT_NEAR(v_b.tail<2>().norm(), 0.0, 1e-9);
  const Vector3 euler = eulerFrom_q_b_to_n(start.initial->nav.q_b_to_n);
  const Vector3 truth = eulerFrom_q_b_to_n(start.truth.q_b_to_n);
  EXPECT_LT((euler - truth).head<2>().norm(), degToRad(1.5));
  EXPECT_NEAR(euler.z(), degToRad(config.initialization.heading_deg), 1e-9);
  const ErrorVector variance = start.initial->P.diagonal();
  EXPECT_GE(std::sqrt(variance(kAttitude)), degToRad(config.initialization.moving_level_std_deg));
  EXPECT_NEAR(std::sqrt(variance(kVelocity)), config.initialization.moving_speed_std_mps, 1e-9);
}

/// A start that is driven by a constant command after 12 s of rest.
struct CommandedStart {
  std::optional<InitialState> initial;
  double heading_error_rad = 0.0;
};

CommandedStart initializeUnder(const sim::Command& command) {
  Config config = startConfig(6);
  config.simulator.drive.initial_straight_m = 0.0;
  const Planet planet = Planet::byName(config.planet);
  const NavigationSetup setup = config.navigation();
  const WheelGeometry geometry = config.wheelGeometry();
  Initializer initializer(planet, setup.initialization, setup.imu_input, setup.filter);
  sim::RoverSimulator rover(config.simulator, planet);
  CommandedStart start;
  double true_heading_rad = 0.0;
  for (int i = 0; i < 3000 && !start.initial; ++i) {
    const sim::Measurements m = rover.step(i < 600 ? sim::Command{} : command);
    if (m.gps) {
      initializer.push(toPositionFix(*m.gps));
    }
    if (m.wheel) {
      initializer.push(toWheelMotion(geometry, *m.wheel));
    }
    initializer.push(m.imu);
    start.initial = initializer.result();
    true_heading_rad = rover.truth().heading_rad;
  }
  EXPECT_TRUE(start.initial) << initializer.progress();
  if (start.initial) {
    start.heading_error_rad = wrapToPi(eulerFrom_q_b_to_n(start.initial->nav.q_b_to_n).z() - true_heading_rad);
  }
  return start;
}

TEST(Initializer, ConfiguredBiasesAreTaken) {
  Config config = startConfig(5);
  config.simulator.drive.initial_straight_m = 20.0;
  config.initialization.source = "motion";
  config.initialization.leveling_window_s = 5.0;
  config.initialization.gyro_bias_deg_per_h = {36.0, -18.0, 9.0};
  Interference late;
  late.ignore_before_s = 15.0;
  const Start start = initialize(config, late);
  ASSERT_TRUE(start.initial);
  const Vector3 expected = degToRad(1.0) / 3600.0 * Vector3(36.0, -18.0, 9.0);
  EXPECT_LT((start.initial->nav.gyro_bias_b - expected).norm(), 1e-12);
}

/// The drive may as well go backwards: the heading is that of the rover, not of its course.
TEST(Initializer, ABackwardDriveGivesTheSameHeading) {
  const CommandedStart start = initializeUnder({-0.8, 0.0});
  ASSERT_TRUE(start.initial);
  EXPECT_NEAR(start.heading_error_rad, 0.0, degToRad(5.0));
  EXPECT_LT((start.initial->nav.q_b_to_n.conjugate() * start.initial->nav.v_eb_n).x(), -0.5);
}

/// Nor need it be straight: wheels and gyro follow the bend.
TEST(Initializer, ACurvedDriveGivesTheHeading) {
  for (const double yaw_rate_radps : {0.06, -0.06}) {
    const CommandedStart start = initializeUnder({0.8, yaw_rate_radps});
    ASSERT_TRUE(start.initial);
    EXPECT_NEAR(start.heading_error_rad, 0.0, degToRad(5.0)) << yaw_rate_radps;
  }
}

TEST(Initializer, TruthIsTakenAsItIs) {
  Config config;
  config.initialization.source = "truth";
  config.initialization.position_std_m = 0.02;
  const NavigationSetup setup = config.navigation();
  Initializer initializer(Planet::byName("earth"), setup.initialization, setup.imu_input, setup.filter);
  EXPECT_FALSE(initializer.result());
  NavigationState truth;
  truth.stamp = 77;
  truth.q_b_to_n = q_b_to_n_fromEuler(0.1, 0.2, 0.3);
  truth.position = {0.7, 0.1, 50.0};
  initializer.setTruth(truth, true);
  const std::optional<InitialState> initial = initializer.result();
  ASSERT_TRUE(initial);
  EXPECT_EQ(initial->nav.stamp, 77);
  EXPECT_TRUE(initial->nav.q_b_to_n.coeffs() == truth.q_b_to_n.coeffs());
  EXPECT_NEAR(initial->P(kPosition, kPosition), 4e-4, 1e-12);
  initializer.reset();
  EXPECT_FALSE(initializer.result());
}

/// The clocks of all sensors have been set back to where they were.
TEST(Initializer, StartsAgainLikeAFreshOne) {
  const Config config = startConfig(2);
  const Planet planet = Planet::byName(config.planet);
  const WheelGeometry geometry = config.wheelGeometry();
  std::vector<sim::Measurements> drive;
  NeverStop policy;
  simulateDrive(config.simulator, planet, policy,
                [&](const sim::Measurements& m, const sim::TruthState&) { drive.push_back(m); });
  const NavigationSetup setup = config.navigation();
  Initializer initializer(planet, setup.initialization, setup.imu_input, setup.filter);
  Nanoseconds newest_wheels = 0;
  const auto start = [&] {
    for (const sim::Measurements& m : drive) {
      if (m.gps) {
        initializer.push(toPositionFix(*m.gps));
      }
      if (m.wheel) {
        initializer.push(toWheelMotion(geometry, *m.wheel));
        newest_wheels = m.wheel->stamp;
      }
      initializer.push(m.imu);
      if (const std::optional<InitialState> initial = initializer.result()) {
        EXPECT_EQ(initial->nav.stamp, newest_wheels) << "as soon as the wheels are known up to a fix";
        return *initial;
      }
    }
    return InitialState{};
  };
  const InitialState first = start();
  ASSERT_GT(first.nav.stamp, 0);
  initializer.reset();
  const InitialState second = start();
  EXPECT_EQ(second.nav.stamp, first.nav.stamp);
  EXPECT_TRUE(sameState(second.nav, first.nav));
  EXPECT_EQ(second.P, first.P);
}

TEST(Initializer, IsNotMisledByBadSamples) {
  Config config;
  const NavigationSetup setup = config.navigation();
  Initializer initializer(Planet::byName("earth"), setup.initialization, setup.imu_input, setup.filter);
  const double nan = std::nan("");
  initializer.push(ImuSample{5, Vector3(nan, 0.0, 0.0), Vector3::Zero()});
  WheelMotion wheels;
  wheels.motion.forward_mps = nan;
  initializer.push(wheels);
  PositionFix fix;
  fix.position.latitude_rad = nan;
  initializer.push(fix);
  EXPECT_FALSE(initializer.result());
}

/// A gap longer than the leveling window leaves one sample in it.
TEST(Initializer, LevelsAfterAGapOfTheImu) {
  for (const std::string source : {"given", "gnss"}) {
    Config config;
    config.initialization.source = source;
    config.initialization.leveling_window_s = 2.0;
    const NavigationSetup setup = config.navigation();
    Initializer initializer(Planet::byName("earth"), setup.initialization, setup.imu_input, setup.filter);
    const Nanoseconds after_gap = fromSeconds(20.0);
    const auto push = [&](Nanoseconds stamp) {
      const double t_s = toSeconds(stamp);
      initializer.push(PositionFix{stamp, {0.7 + 1e-6 * t_s, 0.1, 50.0}, Vector3::Constant(1e-4)});
      WheelMotion wheels;
      wheels.stamp = stamp;
      wheels.motion.forward_mps = 6.0;
      initializer.push(wheels);
      initializer.push(ImuSample{stamp, Vector3(0.0, 0.0, -9.8), Vector3::Zero()});
    };
    push(0);
    std::optional<InitialState> initial;
    for (int i = 0; i < 500 && !initial; ++i) {
      push(after_gap + fromSeconds(0.02 * i));
      initial = initializer.result();
    }
    ASSERT_TRUE(initial) << source;
    EXPECT_GE(initial->nav.stamp, after_gap) << source;
  }
}

}  // namespace
}  // namespace slipnav::test
