#include "config/topics.h"

#include "config/sensor_topics.h"

namespace slipnav {

void TopicNames::visit(ParameterVisitor& v) {
  v.text("imu/data", imu, "in: sensor_msgs/Imu");
  v.text("joint_states", joint_states, "in: sensor_msgs/JointState, the wheels' rates or angles");
  v.text("wheel_odometry", wheel_odometry, "in: nav_msgs/Odometry, instead of joint_states");
  v.text("gps/fix", gps_fix, "in: sensor_msgs/NavSatFix, for the start, and while driving with gnss.use: always");
  v.text("gps/velocity", gps_velocity, "in: geometry_msgs/TwistWithCovarianceStamped, the same, optional");
  v.text("truth/fix", truth_fix, "in: sensor_msgs/NavSatFix, the truth for overlay and metrics only");
  v.text("truth/odometry", truth_odometry, "in: nav_msgs/Odometry, the same");
  v.text("truth/pose", truth_pose, "in: geometry_msgs/PoseStamped, the same");
  v.text("cmd_vel_in", cmd_vel_in, "in: geometry_msgs/Twist, what the operator commands");
  v.text("cmd_vel", cmd_vel, "out: geometry_msgs/Twist, the command for the base");
  v.text("odometry", odometry, "out: nav_msgs/Odometry, the estimate at IMU rate");
  v.text("nav_state", nav_state, "out: slipnav/NavState, the full state with its covariance");
  v.text("slip", slip, "out: slipnav/Slip, slip ratio of each wheel and slip angle");
  v.text("slip_forecast", slip_forecast, "out: slipnav/SlipForecast");
  v.text("error_forecast", error_forecast, "out: slipnav/ErrorForecast, bound on the position error and time to stop");
  v.text("stop", stop, "out: slipnav/StopStatus");
  v.text("stop_cmd", stop_cmd, "out: std_msgs/Float64, seconds until the stop, always finite");
  v.text("e_stop", e_stop, "out: std_msgs/Bool, emergency stop, as the lock of a command multiplexer");
  v.text("diagnostics", diagnostics, "out: diagnostic_msgs/DiagnosticArray");
  v.text("path", path, "out: nav_msgs/Path, the estimate");
  v.text("truth/path", truth_path, "out: nav_msgs/Path, the truth");
  v.text("wheel_path", wheel_path, "out: nav_msgs/Path, dead reckoning from wheels and gyro");
  v.text("markers", markers, "out: visualization_msgs/MarkerArray");
}

std::vector<std::string> sensorTopics(const TopicNames& topics) {
  return {topics.imu,          topics.joint_states, topics.wheel_odometry, topics.gps_fix,
          topics.gps_velocity, topics.truth_fix,    topics.truth_odometry, topics.truth_pose};
}

}  // namespace slipnav
