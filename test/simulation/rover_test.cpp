#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "simulation/driver.h"
#include "simulation/rover_motion.h"
#include "simulation/simulator.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav::sim {
namespace {

SimulatorParams drive(const std::string& terrain, int seed, double distance_m) {
  SimulatorParams params;
  params.terrain = terrain;
  params.seed = seed;
  params.drive.distance_m = distance_m;
  return params;
}

double secondsIn(const TruthState& truth) { return toSeconds(truth.stamp) - SimulatorParams().start_time_s; }

/// Calls `look(truth, measurements)` after each interval of a scripted drive; `hold(truth)` says when to stop.
/// Throws when the drive does not come to its end.
template <class Hold, class Look>
void run(const SimulatorParams& params, const Hold& hold, const Look& look) {
  RoverSimulator rover(params, Planet::byName("earth"));
  Driver driver(params);
  while (!driver.finished()) {
    const Command command = driver.command(rover.truth());
    const Measurements measurements = rover.step(hold(rover.truth()) ? Command{} : command);
    look(rover.truth(), measurements);
    if (secondsIn(rover.truth()) > 1000.0) {
      throw std::runtime_error("the drive does not end");
    }
  }
}

const auto kNeverHold = [](const TruthState&) { return false; };

/// Stands for 5 s in every 20 s after the first minute.
bool holdPeriodically(const TruthState& truth) {
  const double t_s = secondsIn(truth) - 60.0;
  return t_s > 0.0 && std::fmod(t_s, 20.0) > 15.0;
}

TEST(SimSlipRatio, FollowsThePapersDefinition) {
  EXPECT_DOUBLE_EQ(slipRatio(0.6, 0.8), 0.25);             // driving: 1 − v/(rω)
  EXPECT_DOUBLE_EQ(slipRatio(0.8, 0.6), 0.6 / 0.8 - 1.0);  // braking: rω/v − 1
  EXPECT_DOUBLE_EQ(slipRatio(-0.6, -0.8), 0.25);           // reverse
  EXPECT_DOUBLE_EQ(slipRatio(0.0, 0.5), 1.0);
  EXPECT_DOUBLE_EQ(slipRatio(0.5, 0.0), -1.0);
  EXPECT_DOUBLE_EQ(slipRatio(-0.1, 0.5), 1.0);  // limited
  EXPECT_DOUBLE_EQ(slipRatio(0.0, 0.0), 0.0);
}

TEST(SimRover, SlipIsWheelSpeedAgainstTrueSpeedAtThatWheel) {
  const SimulatorParams params = drive("rough", 2, 60.0);
  const double half_track_m = 0.5 * params.vehicle.track_m;
  double largest = 0.0;
  run(params, kNeverHold, [&](const TruthState& truth, const Measurements&) {
    for (std::size_t i = 0; i < kWheelCount; ++i) {
      const bool left = i == 0 || i == 2;
      const Vector3 wheel_b(0.0, left ? -half_track_m : half_track_m, 0.0);
      // planet rotation is 7e-5 rad/s: part of omega_ib, not of the motion over the ground
      const Vector3 velocity = truth.v_eb_b + truth.omega_ib_b.cross(wheel_b);
      const double surface_mps = truth.wheel_radius_m[i] * truth.wheel_rate_radps[i];
      if (surface_mps > 0.1) {
        EXPECT_NEAR(truth.slip[i], slipRatio(velocity.x(), surface_mps), 5e-4);
        largest = std::max(largest, truth.slip[i]);
      }
    }
  });
  EXPECT_GT(largest, 0.3);
}

TEST(SimRover, MovesAlongTheGroundBesideSideSlipAndHeave) {
  double moved_m = 0.0;
  double heave2 = 0.0;
  double lift_m = 0.0;
  double moving = 0.0;
  Vector3 last = Vector3::Zero();
  SimulatorParams params = drive("rough", 3, 40.0);
  params.imu.vibration = 0.0;
  run(params, kNeverHold, [&](const TruthState& truth, const Measurements&) {
    EXPECT_NEAR(truth.heading_rad, eulerFrom_q_b_to_n(truth.q_b_to_n).z(), 1e-12);
    const Vector3 v_b = truth.q_b_to_n.conjugate() * truth.v_eb_n;
    EXPECT_LT((v_b - truth.v_eb_b).norm(), 1e-9);
    heave2 += v_b.z() * v_b.z();
    lift_m += 0.02 * v_b.z();
    moving += truth.standstill ? 0.0 : 1.0;
    EXPECT_LT(std::abs(lift_m), 0.02);  // up and down, never away from the ground
    EXPECT_NEAR(v_b.y(), v_b.x() * std::tan(truth.slip_angle_rad), 1e-12);
    moved_m += (truth.position_enu_m - last).norm();
    last = truth.position_enu_m;
    EXPECT_NEAR(truth.distance_m, moved_m, 1e-3 * moved_m + 5e-3);
  });
  EXPECT_NEAR(std::sqrt(heave2 / moving), 0.013, 0.008);
}

TEST(SimRover, StandsExactlyStillDuringStops) {
  TruthState held;
  int still_samples = 0;
  int stops = 0;
  SimulatorParams params = drive("rough", 4, 60.0);
  params.imu.vibration = 0.0;  // not even the tremor of fans and wind
  run(params, holdPeriodically, [&](const TruthState& truth, const Measurements&) {
    if (truth.standstill && held.standstill && held.stamp != 0) {
      ++still_samples;
      EXPECT_EQ(truth.position_enu_m, held.position_enu_m);
      EXPECT_EQ(truth.q_b_to_n.coeffs(), held.q_b_to_n.coeffs());
      EXPECT_EQ(truth.v_eb_n, Vector3(Vector3::Zero()));
      EXPECT_EQ(truth.wheel_rate_radps, PerWheel{});
    }
    stops += truth.standstill && held.stamp != 0 && !held.standstill ? 1 : 0;
    held = truth;
  });
  EXPECT_GE(stops, 4);
  EXPECT_GT(still_samples, 50 * (30 + 5 + 2 * stops));
}

TEST(SimRover, AccelerationStaysWithinWhatWheelsCanDo) {
  double speed_mps = 0.0;
  run(drive("rough", 5, 100.0), holdPeriodically, [&](const TruthState& truth, const Measurements&) {
    EXPECT_LT(std::abs(truth.v_eb_b.x() - speed_mps) * 50.0, 6.0);
    speed_mps = truth.v_eb_b.x();
  });
}

/// Everything a drive says, to compare drives with each other.
struct Record {
  std::vector<Vector3> position, force, rate, gps, truth_fix;
  std::vector<double> wheel;
};

Vector3 asVector(const GnssFix& fix) { return {fix.latitude_deg, fix.longitude_deg, fix.height_m}; }

Record record(const SimulatorParams& params) {
  Record out;
  run(params, kNeverHold, [&](const TruthState& truth, const Measurements& m) {
    out.position.push_back(truth.position_enu_m);
    out.force.push_back(m.imu.f_ib_b);
    out.rate.push_back(m.imu.omega_ib_b);
    if (m.wheel) out.wheel.insert(out.wheel.end(), m.wheel->rate_radps.begin(), m.wheel->rate_radps.end());
    if (m.gps) out.gps.push_back(asVector(*m.gps));
    if (m.truth) out.truth_fix.push_back(asVector(*m.truth));
  });
  return out;
}

TEST(SimRover, RepeatsExactlyForASeedAndDiffersForAnother) {
  const Record a = record(drive("gravel", 11, 30.0));
  const Record b = record(drive("gravel", 11, 30.0));
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.rate, b.rate);
  EXPECT_EQ(a.wheel, b.wheel);
  EXPECT_EQ(a.gps, b.gps);
  EXPECT_EQ(a.truth_fix, b.truth_fix);
  const Record c = record(drive("gravel", 12, 30.0));
  EXPECT_NE(a.position.back(), c.position.back());
  EXPECT_NE(a.force.front(), c.force.front());
}

TEST(SimRover, OneSensorsSettingsLeaveTheOthersNumbersAlone) {
  const SimulatorParams params = drive("gravel", 13, 30.0);
  const Record base = record(params);

  SimulatorParams imu = params;
  imu.imu.gyro_noise_deg_per_sqrt_h *= 3.0;
  imu.imu.vibration = 0.0;
  const Record noisy = record(imu);
  EXPECT_NE(base.rate, noisy.rate);
  EXPECT_EQ(base.position, noisy.position);
  EXPECT_EQ(base.wheel, noisy.wheel);
  EXPECT_EQ(base.gps, noisy.gps);

  SimulatorParams others = params;
  others.encoder.rate_hz = 20.0;
  others.gps.rate_hz = 5.0;
  const Record rates = record(others);
  EXPECT_NE(base.gps.size(), rates.gps.size());
  EXPECT_NE(base.wheel.size(), rates.wheel.size());
  EXPECT_EQ(base.position, rates.position);
  EXPECT_EQ(base.force, rates.force);
  EXPECT_EQ(base.truth_fix, rates.truth_fix);
}

TEST(SimRover, StopsLeaveRouteAndSlipAsTheyWere) {
  struct Place {
    double distance_m;
    double slip;
    Vector3 position;
  };
  const auto drivenPlaces = [](const auto& hold) {
    std::vector<Place> places;
    run(drive("rough", 6, 120.0), hold, [&](const TruthState& truth, const Measurements&) {
      if (truth.v_eb_b.x() > 0.3) {
        places.push_back({truth.distance_m, 0.25 * (truth.slip[0] + truth.slip[1] + truth.slip[2] + truth.slip[3]),
                          truth.position_enu_m});
      }
    });
    return places;
  };
  const std::vector<Place> through = drivenPlaces(kNeverHold);
  const std::vector<Place> stopping = drivenPlaces(holdPeriodically);
  double off_route_m = 0.0;
  double slip_difference = 0.0;
  for (const Place& place : stopping) {
    const auto near = std::min_element(through.begin(), through.end(), [&](const Place& a, const Place& b) {
      return std::abs(a.distance_m - place.distance_m) < std::abs(b.distance_m - place.distance_m);
    });
    off_route_m = std::max(off_route_m, (near->position - place.position).norm());
    slip_difference += std::abs(near->slip - place.slip) / static_cast<double>(stopping.size());
  }
  EXPECT_LT(off_route_m, 1.0);
  EXPECT_LT(slip_difference, 0.015);
}

TEST(SimDriver, RestsDrivesStraightThenTheDistanceThenRests) {
  SimulatorParams params = drive("unpaved", 7, 25.0);
  RoverSimulator rover(params, Planet::byName("earth"));
  Driver driver(params);
  const double heading_rad = eulerFrom_q_b_to_n(rover.truth().q_b_to_n).z();
  double straight_m = -1.0;
  while (!driver.finished()) {
    const Command command = driver.command(rover.truth());
    if (secondsIn(rover.truth()) < params.drive.initial_rest_s) {
      EXPECT_TRUE(rover.truth().standstill);
    }
    if (!driver.initializationDriveDone()) {
      EXPECT_NEAR(wrapToPi(eulerFrom_q_b_to_n(rover.truth().q_b_to_n).z() - heading_rad), 0.0, degToRad(2.0));
    } else if (straight_m < 0.0) {
      straight_m = rover.truth().distance_m;
    }
    rover.step(command);
  }
  EXPECT_NEAR(straight_m, params.drive.initial_straight_m, 0.05);
  EXPECT_GT(rover.truth().distance_m - straight_m, params.drive.distance_m);
  EXPECT_LT(rover.truth().distance_m - straight_m, params.drive.distance_m + 1.5);  // way to stop
  EXPECT_TRUE(rover.truth().standstill);
}

}  // namespace
}  // namespace slipnav::sim
