/// Starts from all sources, with antennas, biases and receivers of all kinds: no change of an initial state or of its
/// covariance goes without being noticed.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "core/navigation/checkpoint.h"
#include "reference_trace.h"
#include "simulated_start.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav::test {
namespace {

void note(const std::string& name, const Start& start, ReferenceTrace& trace) {
  if (!start.initial) {
    trace.note(name, "none", start.progress, start.said.size());
    return;
  }
  const InitialState& initial = *start.initial;
  const Vector3 euler = eulerFrom_q_b_to_n(initial.nav.q_b_to_n);
  trace.note(name, initial.nav.stamp % (1000 * kSecond), euler.x(), euler.y(), euler.z(), initial.nav.v_eb_n.norm(),
             initial.nav.position.latitude_rad, initial.nav.position.longitude_rad, initial.nav.position.height_m,
             initial.nav.accel_bias_b.norm(), initial.nav.gyro_bias_b.norm(), start.said.size());
  const Vector3 from_origin = positionDifference(Planet::byName("earth"), initial.nav.position, initial.origin);
  trace.note("  ", initial.P.diagonal().segment<3>(kAttitude).norm(), initial.P.diagonal().segment<3>(kVelocity).norm(),
             initial.P.diagonal().segment<3>(kPosition).norm(), initial.P.diagonal().segment<3>(kAccelBias).norm(),
             initial.P.diagonal().segment<3>(kGyroBias).norm(), initial.P.norm(), from_origin.norm(),
             initial.standstill_variance, initial.P.block<3, 3>(kAttitude, kAccelBias).norm());
}

/// Under satellite positions.
TEST(StartReference, DrivesGiveTheSame) {
  ReferenceTrace trace("starts_of_drives");
  const auto add = [&trace](const std::string& name, const std::function<void(Config&, Interference&)>& change) {
    Config config = startConfig(7);
    Interference interference;
    change(config, interference);
    note(name, initialize(config, interference), trace);
  };
  add("usual", [](Config&, Interference&) {});
  add("antenna", [](Config& c, Interference&) {
    c.gps_mount.x_m = c.simulator.gps.antenna_x_m = -0.6;
    c.gps_mount.z_m = 1.5;
  });
  add("velocities", [](Config& c, Interference& i) {
    c.simulator.gps.horizontal_noise_m = 0.5;
    i.velocity_std_mps = 0.05;
  });
  add("late", [](Config& c, Interference& i) {
    c.simulator.drive.initial_straight_m = 20.0;
    i.ignore_before_s = 14.0;
  });
  add("outage", [](Config&, Interference& i) {
    i.no_fixes_from_s = 14.0;
    i.no_fixes_until_s = 19.0;
  });
  add("biases", [](Config& c, Interference&) {
    c.initialization.gyro_bias_deg_per_h = {20.0, -30.0, 40.0};
    c.initialization.accel_bias_ug = {500.0, -1000.0, 200.0};
    c.simulator.imu.gyro_turn_on_bias_deg_per_h = 900.0;
  });
  add("poor", [](Config& c, Interference&) {
    c.simulator.gps.horizontal_noise_m = 2.0;
    c.simulator.gps.rate_hz = 2.0;
    c.simulator.drive.initial_straight_m = 60.0;
  });
  add("wheels", [](Config& c, Interference&) {
    for (WheelParams& wheel : c.wheels) {
      wheel.radius_m *= 2.2;
    }
  });
  trace.compare();
}

/// From the configuration, at rest and on the move.
TEST(StartReference, ConfigurationsGiveTheSame) {
  ReferenceTrace trace("starts_of_configurations");
  for (const char* source : {"given", "motion"}) {
    for (const double from_s : {0.0, 9.0, 11.6, 15.0}) {
      Config config = startConfig(8);
      config.simulator.drive.initial_straight_m = 20.0;
      config.initialization.source = source;
      config.initialization.heading_deg = 50.0;
      config.initialization.leveling_window_s = 3.0;
      config.initialization.accel_bias_ug = {500.0, -1000.0, 200.0};
      config.initialization.gyro_bias_deg_per_h = {20.0, -30.0, 40.0};
      Interference interference;
      interference.ignore_before_s = from_s;
      note(source + std::to_string(from_s), initialize(config, interference), trace);
    }
  }
  trace.compare();
}

/// The format of the files that are out there.
TEST(StartReference, ACheckpointIsWrittenTheSameWay) {
  Checkpoint checkpoint;
  InitialState& state = checkpoint.state;
  state.nav.stamp = 1'600'000'000'123'456'789;
  state.nav.q_b_to_n = Quaternion(0.5, -0.5, 0.5, 0.5);
  state.nav.v_eb_n = {0.25, 0.5, -0.125};
  state.nav.position = {0.75, -1.5, 300.25};
  state.nav.accel_bias_b = {0.5, -2.0, 3.0};
  state.nav.gyro_bias_b = {0.25, -0.75, 0.375};
  state.nav.imu_offset_b = {1.0, 2.0, 4.0};
  state.vehicle = {0.0625, 0.125, 0.25, 0.5, 0.75, 1.0};
  state.origin = {0.5, -1.25, 299.0};
  state.standstill_variance = 0.1;
  checkpoint.session = 3;
  checkpoint.slip_hyperparameters = {0.5, 2.5};
  const std::string text = formatCheckpoint(checkpoint);
  const std::string head =
      "slipnav checkpoint 2\nstamp 1600000000123456789\nsession 3\nq_b_to_n 0.5 -0.5 0.5 0.5\n"
      "v_eb_n 0.25 0.5 -0.125\nposition 0.75 -1.5 300.25\naccel_bias_b 0.5 -2 3\ngyro_bias_b 0.25 -0.75 0.375\n"
      "imu_offset_b 1 2 4\nvehicle 0.0625 0.125 0.25 0.5 0.75 1\norigin 0.5 -1.25 299\n"
      "standstill_variance 0.10000000000000001\nslip_hyperparameters 0.5 2.5\ncovariance 1 0 0";
  EXPECT_EQ(text.substr(0, head.size()), head);
  const std::string checksum = text.substr(text.rfind('\n', text.size() - 2) + 1);
  EXPECT_EQ(checksum, "checksum cda11e0ad89f84da\n");
  const InitialState back = parseCheckpoint(text).state;
  EXPECT_EQ(back.nav.imu_offset_b, state.nav.imu_offset_b);
  EXPECT_EQ(back.nav.position.height_m, 300.25);
  EXPECT_EQ(back.origin.latitude_rad, 0.5);
  EXPECT_EQ(back.origin.height_m, 299.0);
}

}  // namespace
}  // namespace slipnav::test
