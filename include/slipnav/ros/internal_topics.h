#pragma once
/// Topics between the nodelets of one manager, relative to their namespace.

namespace slipnav {

inline constexpr const char* kInitialStateTopic = "initial_state";
inline constexpr const char* kInsStepsTopic = "ins_steps";
inline constexpr const char* kCorrectionTopic = "correction";
inline constexpr const char* kInitializationTopic = "initialization";
/// Filter to Forecast: slipnav/ForecastInput, one per wheel interval.
inline constexpr const char* kForecastInputTopic = "forecast_input";
/// Forecast to StopSupervisor: std_msgs/Header, stamp of the newest estimate dealt with. A forecast that was made with
/// it was published before.
inline constexpr const char* kForecastProgressTopic = "forecast_progress";
/// From a nodelet whose parameters were changed to all others: dynamic_reconfigure/Config, what it was changed to.
inline constexpr const char* kTuningTopic = "tuning";
/// Overlay to robot_state_publisher: the wheels of the model in rviz.
inline constexpr const char* kModelJointsTopic = "model/joint_states";

}  // namespace slipnav
