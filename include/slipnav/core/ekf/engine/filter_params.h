#pragma once
/// Everything the filter is configured with.

#include <string>
#include <vector>

#include "slipnav/core/ekf/adaptation/noise_scales.h"
#include "slipnav/core/ekf/error_dynamics.h"
#include "slipnav/core/ekf/models/gnss_fix.h"
#include "slipnav/core/ekf/models/nonholonomic.h"
#include "slipnav/core/ekf/models/wheel_odometry.h"
#include "slipnav/core/ekf/models/zero_motion.h"
#include "slipnav/core/ekf/stationary_detector.h"
#include "slipnav/core/parameters/parameter_visitor.h"
#include "slipnav/core/sensors/wheel_monitor.h"

namespace slipnav {

/// Block `filter`.
struct FilterParams {
  std::vector<std::string> updates = {"wheel", "nonholonomic", "zupt", "zaru"};
  double gate_alpha = 0.001;
  double zero_velocity_gate_alpha = 1e-6;
  double max_rejection_s = 3.0;
  double max_standstill_doubt_s = 0.8;
  double max_wait_s = 1.0;
  double max_wheel_interval_s = 0.5;
  double gap_rate_std_deg_per_s = 2.0;
  double gap_accel_std_mps2 = 0.3;
  double gap_max_tilt_deg = 4.0;
  NoiseScaleParams adaptation;
  void visit(ParameterVisitor& v);

  bool uses(const std::string& update) const;
};

/// The blocks that the filter depends on, and the lever arms that follow from the mounts.
struct FilterSetup {
  FilterParams filter;
  ImuNoiseParams imu;
  VehicleModelParams vehicle;
  WheelOdometryParams wheel;
  NonholonomicParams nonholonomic;
  ZeroMotionParams zero;
  StationaryParams stationary;
  WheelMonitorParams wheel_monitor;
  FixParams gnss;
  std::vector<WheelParams> wheels;
  Vector3 lever_imu_to_reference_b = Vector3::Zero();  ///< from the IMU to the vehicle's center of turn [m]
  Vector3 lever_imu_to_antenna_b = Vector3::Zero();    ///< from the IMU to the antenna of gps/fix [m]
};

}  // namespace slipnav
