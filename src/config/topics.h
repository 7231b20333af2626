#pragma once
/// The topic names, and what a robot or a recording calls them.

#include <string>

#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// The key of each field in YAML is its default name.
struct TopicNames {
  std::string imu = "imu/data";
  std::string joint_states = "joint_states";
  std::string wheel_odometry = "wheel_odometry";
  std::string gps_fix = "gps/fix";
  std::string gps_velocity = "gps/velocity";
  std::string truth_fix = "truth/fix";
  std::string truth_odometry = "truth/odometry";
  std::string truth_pose = "truth/pose";
  std::string cmd_vel_in = "cmd_vel_in";
  std::string cmd_vel = "cmd_vel";
  std::string odometry = "odometry";
  std::string nav_state = "nav_state";
  std::string slip = "slip";
  std::string slip_forecast = "slip_forecast";
  std::string error_forecast = "error_forecast";
  std::string stop = "stop";
  std::string stop_cmd = "stop_cmd";
  std::string e_stop = "e_stop";
  std::string diagnostics = "diagnostics";
  std::string path = "path";
  std::string truth_path = "truth/path";
  std::string wheel_path = "wheel_path";
  std::string markers = "markers";

  void visit(ParameterVisitor& v);
};

}  // namespace slipnav
