#pragma once
/// A drive as a recording, from formulas: to be spoilt in one way and inspected.

#include "inspection/recording.h"

namespace slipnav::test {

/// How the recording is made.
struct SyntheticDrive {
  double duration_s = 120.0;
  Matrix3 C_sensor_to_flu = Matrix3::Identity();
  double radius_m = 0.1;
  double track_m = 0.6;
};

/// Stands for 5 s of every 15 s, drives at 0.5 m/s with turns between; imu/data at 50 Hz with noise, joint_states with
/// four wheels at 10 Hz (velocities and positions), truth/fix at 5 Hz. Every message is received 10 ms after its stamp.
Recording syntheticRecording(const SyntheticDrive& drive = {});

}  // namespace slipnav::test
