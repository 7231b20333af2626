/// What makes worlds out of grounds: body, patches, shaking, host stamps, layouts, places to get stuck.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "config/config.h"
#include "config/yaml_document.h"
#include "core/base/square.h"
#include "simulation/driver.h"
#include "simulation/rover_motion.h"
#include "simulation/sensor_models.h"
#include "simulation/shaking.h"
#include "simulation/simulator.h"
#include "simulation/soft_patches.h"
#include "simulation/world_files.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav::sim {
namespace {

const std::string kWorlds = SLIPNAV_SOURCE_DIR "/config/worlds";
const std::string kGrades = SLIPNAV_SOURCE_DIR "/config/grades";

TEST(SimWorlds, EveryWorldLoadsWithEveryGradeAndSimulates) {
  const std::vector<std::string> worlds = configurationsIn(kWorlds);
  EXPECT_GE(worlds.size(), 30U);
  for (const std::string& world : worlds) {
    for (const std::string& grade : configurationsIn(kGrades)) {
      const Config config = Config::load({configurationNamed(grade, kGrades, "grade"),  //
                                          configurationNamed(world, kWorlds, "world")});
      RoverSimulator rover(config.simulator, Planet::byName("earth"));
      EXPECT_GT(rover.step({}).imu.stamp, 0) << world;
      EXPECT_EQ(config.wheels.size(), wheelsOf(config.simulator.vehicle.layout)) << world;
    }
  }
}

TEST(SimWorlds, AWorldTellsTheFilterNothingButTheRoversOwnMeasures) {
  for (const std::string& world : configurationsIn(kWorlds)) {
    const YAML::Node document = loadYamlFile(configurationNamed(world, kWorlds, "world"));
    for (const auto& block : document) {
      const auto name = block.first.as<std::string>();
      EXPECT_TRUE(name == "simulator" || name == "wheels" || name == "wheel") << world << ": " << name;
      if (name == "wheel") {
        EXPECT_EQ(block.second.size(), 1U) << world;
        EXPECT_TRUE(block.second["scrub_factor"]) << world;
      }
    }
  }
}

TEST(SimWorlds, AnUnknownOneIsNamedBesideTheKnownOnes) {
  try {
    configurationNamed("moon", kWorlds, "world");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("world 'moon' is not known (circle, "), std::string::npos) << error.what();
  }
}

/// Rates of pose against its differences, over a drive on a body that rocks and then comes to rest.
void expectRatesToBelongToThePose(const BodyParams& body) {
  constexpr double kStep_s = 1e-3;
  RoverMotion motion({}, groundByName("rough"), 0.3, 1.0, 5, body);
  double rate_sum = 0.0;
  double vertical_sum2 = 0.0;
  for (int i = 0; i < 30000; ++i) {
    const Kinematics before = motion.state();
    motion.advance(i < 20000 ? 0.8 : 0.0, i < 20000 ? 0.1 : 0.0, kStep_s);
    const Kinematics& now = motion.state();
    const Vector3 v = 0.5 * (before.v_eb_enu + now.v_eb_enu);
    ASSERT_LT(((now.position_enu_m - before.position_enu_m) / kStep_s - v).norm(), 2e-3) << i;
    const Matrix3 turned = before.C_b_to_enu.transpose() * now.C_b_to_enu;
    const Vector3 omega(turned(2, 1) - turned(1, 2), turned(0, 2) - turned(2, 0), turned(1, 0) - turned(0, 1));
    ASSERT_LT((0.5 * omega / kStep_s - 0.5 * (before.omega_eb_b + now.omega_eb_b)).norm(), 2e-3) << i;
    rate_sum += now.omega_eb_b.head<2>().norm();
    vertical_sum2 += i < 20000 ? square(now.v_eb_b.z()) : 0.0;
  }
  EXPECT_GT(rate_sum / 30000.0, 0.02);
  EXPECT_GT(std::sqrt(vertical_sum2 / 20000.0), 0.015);
  EXPECT_TRUE(motion.state().standstill);
}

BodyParams stones(double frequency_hz) {
  BodyParams body;
  body.heave_m = 0.012;
  body.sway_m = 0.02;
  body.pitch_deg = 2.0;
  body.roll_deg = 2.5;
  body.frequency_hz = frequency_hz;
  return body;
}

TEST(SimBody, VelocityAndRateOfAStiffBodyBelongToItsPose) { expectRatesToBelongToThePose(stones(0.0)); }

TEST(SimBody, VelocityAndRateOfASprungBodyBelongToItsPose) { expectRatesToBelongToThePose(stones(1.5)); }

TEST(SimBody, ASprungBodySwingsOnAfterTheWheelsStand) {
  RoverMotion motion({}, groundByName("rough"), 0.3, 1.0, 5, stones(1.5));
  double swung_s = 0.0;
  for (int i = 0; i < 20000; ++i) {
    motion.advance(i < 10000 ? 0.8 : 0.0, 0.0, 1e-3);
    const bool wheels_stand = motion.state().wheel_rate_radps == PerWheel{};
    swung_s += i > 10000 && wheels_stand && !motion.state().standstill ? 1e-3 : 0.0;
  }
  EXPECT_GT(swung_s, 0.5);
  EXPECT_LT(swung_s, 5.0);
}

TEST(SimGround, WheelsSpinWhereTheRoverIsStuck) {
  RoverMotion motion({}, groundByName("gravel"), 0.0, 1.0, 7, {}, {5.0, 20.0});
  double standing_s = 0.0;
  for (int i = 0; i < 60000; ++i) {
    motion.advance(0.8, 0.0, 1e-3);
    const Kinematics& state = motion.state();
    if (state.v_eb_enu.head<2>().norm() < 1e-3 && state.wheel_rate_radps[0] > 6.0) {
      standing_s += 1e-3;
      EXPECT_NEAR(state.distance_m, 5.2, 0.25);
      EXPECT_GT(state.slip[0], 0.99);
    }
  }
  EXPECT_NEAR(standing_s, 19.0, 0.3);
  EXPECT_GT(motion.state().distance_m, 25.0);
}

TEST(SimGround, SlipIsHigherBySoMuchInSoftPatches) {
  SoftPatches patches(3.0, 10.0, 2);
  double sum = 0.0;
  double edges = 0.0;
  constexpr int kPoints = 200000;
  for (int i = 0; i < kPoints; ++i) {
    const double soft = patches.at(0.05 * i);
    ASSERT_GE(soft, 0.0);
    ASSERT_LE(soft, 1.0);
    sum += soft;
    edges += soft > 0.0 && soft < 1.0 ? 1.0 : 0.0;
  }
  EXPECT_NEAR(sum / kPoints, 3.0 / 13.3, 0.02);
  EXPECT_NEAR(edges / kPoints, 0.6 / 13.3, 0.02);
}

TEST(SimGround, APointAheadDoesNotMoveSidewaysInATurn) {
  constexpr double kAhead_m = 0.3;
  GroundChangeParams change;
  change.turning_point_m = kAhead_m;
  GroundParams ground = changed(groundByName("rocking"), change);
  RoverMotion motion({}, ground, 0.0, 1.0, 7);
  double largest_rate_radps = 0.0;
  for (int i = 0; i < 20000; ++i) {
    motion.advance(0.5, 0.4 * std::sin(1e-3 * i), 1e-3);
    const Kinematics& state = motion.state();
    EXPECT_NEAR(state.v_eb_b.y() + kAhead_m * state.omega_eb_b.z(), 0.0, 1e-9) << i;
    largest_rate_radps = std::max(largest_rate_radps, state.omega_eb_b.z());
  }
  EXPECT_GT(largest_rate_radps, 0.2);
}

TEST(SimGround, ATiltedPlaneRisesInTheDirectionOfTheStart) {
  GroundChangeParams change;
  change.tilt_deg = 15.0;
  const Terrain level(groundByName("paved").relief, 0.7, 12.0, 3);
  const Terrain tilted(changed(groundByName("paved"), change).relief, 0.7, 12.0, 3);
  const Vector2 ahead(std::sin(0.7), std::cos(0.7));
  for (const double distance_m : {0.0, 5.0, 80.0}) {
    const SurfacePoint a = level.at(distance_m * ahead);
    const SurfacePoint b = tilted.at(distance_m * ahead);
    EXPECT_NEAR(b.height_m - a.height_m, distance_m * std::tan(degToRad(15.0)), 1e-9);
    EXPECT_NEAR((b.gradient - a.gradient).dot(ahead), std::tan(degToRad(15.0)), 1e-12);
  }
}

TEST(SimShaking, IsWhiteWhileDrivingAndLinesOfAnEngineAtRestToo) {
  ShakingParams params;
  params.broad_mps2 = 0.4;
  params.engine_mps2 = 0.1;
  Shaking shaking(params, false, 4);
  double driving = 0.0;
  double resting = 0.0;
  for (int i = 0; i < 4000; ++i) {
    shaking.advance(0.0, 0.02);
    const bool drives = i < 2000;
    (drives ? driving : resting) += shaking.sample(drives ? 1.0 : 0.0).f_ib_b.squaredNorm() / 6000.0;
  }
  const double line2 = 0.5 * square(0.1) * (1.0 + 1.0 / 4.0 + 1.0 / 9.0);
  EXPECT_NEAR(resting, line2, 0.1 * line2);
  EXPECT_NEAR(driving, square(0.4) + line2, 0.01);
}

TEST(SimShaking, AMeanTakesTheMotorsLinesOutThatAnInstantAliases) {
  ShakingParams params;
  params.motor_mps2 = 1.0;
  params.motor_turns_per_m = 100.0;
  double sum2[2] = {};
  for (const bool is_mean : {false, true}) {
    Shaking shaking(params, is_mean, 4);
    for (int i = 1; i <= 20000; ++i) {
      shaking.advance(0.8e-3 * i, 1e-3);
      sum2[is_mean ? 1 : 0] += i % 20 == 0 ? shaking.sample(0.8).f_ib_b.squaredNorm() : 0.0;
    }
  }
  EXPECT_GT(sum2[0] / 3000.0, 0.3);
  EXPECT_LT(sum2[1] / 3000.0, 0.1);
}

TEST(SimHostStamps, KeepTheOrderAndBunch) {
  HostStampParams params;
  params.noise_s = 0.001;
  params.burst = 4;
  HostClock clock(params, 50.0, 1, "test");
  std::vector<double> gaps_s;
  Nanoseconds last = 0;
  for (int i = 1; i <= 4000; ++i) {
    const Nanoseconds instant = i * fromSeconds(0.02);
    const Nanoseconds stamp = clock.stamp(instant);
    ASSERT_GT(stamp, last);
    ASSERT_LT(toSeconds(stamp - instant), 0.065);
    gaps_s.push_back(toSeconds(stamp - last));
    last = stamp;
  }
  const auto bunched = std::count_if(gaps_s.begin(), gaps_s.end(), [](double gap_s) { return gap_s < 0.005; });
  EXPECT_NEAR(static_cast<double>(bunched), 3000.0, 10.0);
}

TEST(SimEncoders, FasterThanTheImuLoseNothing) {
  SimulatorParams params;
  params.encoder.rate_hz = 170.0;
  RoverSimulator rover(params, Planet::byName("earth"));
  std::vector<Nanoseconds> stamps;
  for (int i = 0; i < 100; ++i) {
    const Measurements m = rover.step({0.8, 0.0});
    for (const WheelReading& earlier : m.earlier_wheels) {
      stamps.push_back(earlier.sample.stamp);
    }
    if (m.wheel) {
      stamps.push_back(m.wheel->stamp);
    }
  }
  ASSERT_EQ(stamps.size(), 340U);
  EXPECT_TRUE(std::is_sorted(stamps.begin(), stamps.end()));
  EXPECT_EQ(stamps.back() - stamps.front(), fromSeconds(339.0 / 170.0));
}

TEST(SimEncoders, LayoutsAndADeadOne) {
  EncoderParams params;
  params.counts_per_turn = 1e6;
  params.dead_wheel = 2;
  params.dead_after_s = 1.0;
  EncoderModel two(params, 0, 1, 2);
  EncoderModel six(params, 0, 1, 6);
  const auto rates = [](EncoderModel& encoder, double t_s) {
    return encoder.measure({1.0 * t_s, 2.0 * t_s, 3.0 * t_s, 4.0 * t_s}, fromSeconds(t_s));
  };
  const WheelSample pair = rates(two, 0.5);
  ASSERT_EQ(pair.count, 2U);
  EXPECT_NEAR(pair.rate_radps[0], 2.0, 1e-4);
  EXPECT_NEAR(pair.rate_radps[1], 3.0, 1e-4);
  EXPECT_EQ(rates(two, 1.5).rate_radps[1], 0.0);
  const WheelSample half_dozen = rates(six, 0.5);
  ASSERT_EQ(half_dozen.count, 6U);
  EXPECT_NEAR(half_dozen.rate_radps[2], 2.0, 1e-4);
  EXPECT_NEAR(half_dozen.rate_radps[5], 4.0, 1e-4);
}

TEST(SimImu, AnInstantaneousSampleIsTheStateAtItsStamp) {
  SimulatorParams params;
  params.terrain = "rocking";
  params.imu.error_free = true;
  params.imu.sampling = "instantaneous";
  RoverSimulator rover(params, Planet::byName("earth"));
  double largest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Measurements m = rover.step({0.8, 0.0});
    ASSERT_LT((m.imu.omega_ib_b - rover.truth().omega_ib_b).norm(), 1e-9);
    largest = std::max(largest, m.imu.omega_ib_b.norm());
  }
  EXPECT_GT(largest, 0.05);
}

TEST(SimRoute, ACircleComesBackAndAFastRoverTurnsWide) {
  SimulatorParams params;
  params.drive.route = "circle";
  params.drive.circle_radius_m = 5.0;
  params.drive.distance_m = 2.0 * kPi * 5.0 * 3.0;
  params.terrain = "paved";
  params.drive.initial_rest_s = 1.0;
  RoverSimulator rover(params, Planet::byName("earth"));
  Driver driver(params);
  Vector3 least = Vector3::Constant(1e9);
  Vector3 most = Vector3::Constant(-1e9);
  while (!driver.finished()) {
    rover.step(driver.command(rover.truth()));
    if (rover.truth().distance_m > 40.0) {
      least = least.cwiseMin(rover.truth().position_enu_m);
      most = most.cwiseMax(rover.truth().position_enu_m);
    }
  }
  EXPECT_NEAR(most.x() - least.x(), 10.0, 0.6);
  EXPECT_NEAR(most.y() - least.y(), 10.0, 0.6);
}

}  // namespace
}  // namespace slipnav::sim
