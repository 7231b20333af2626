#pragma once
/// Examines a recording: what is in it, what is wrong with it, and what follows from it.

#include <optional>
#include <string>
#include <vector>

#include "config/config.h"
#include "inspection/clock_offset.h"
#include "inspection/finding.h"
#include "inspection/imu_check.h"
#include "inspection/mounting.h"
#include "inspection/position_check.h"
#include "inspection/recording.h"
#include "inspection/rest.h"
#include "inspection/roles.h"
#include "inspection/wheel_track.h"

namespace slipnav {

/// Prior knowledge about the recording.
struct InspectionOptions {
  std::optional<Config> config;          ///< checked against the recording
  std::optional<MountParams> tf;         ///< pose of the IMU in base_link from /tf and /tf_static
  std::optional<ImuNoiseParams> sensor;  ///< its data sheet
  std::string truth;                     ///< topic or file of the truth; "" to guess
  double wheel_radius_m = 0.0;           ///< 0: not known

  /// imu.noise of the configuration, the data sheet, or the default.
  ImuNoiseParams noise() const { return config ? config->imu.noise : sensor.value_or(ImuNoiseParams{}); }
};

/// All results.
struct Inspection {
  Findings findings;
  Roles roles;                     ///< points into the recording
  std::vector<WheelJoint> wheels;  ///< empty if odometry is used
  WheelTrack track;
  RestPicture rest;
  Mounting mounting;
  ClockOffset clock;
  WheelScale scale;
  TruthTrack fixes;
  TruthTrack truth;
  bool truth_in_start_frame = false;  ///< starts at exactly zero with attitude zero and is not level later
  bool stamps_are_set = true;         ///< of the wheels
};

Inspection inspect(const Recording& recording, const InspectionOptions& options);

}  // namespace slipnav
