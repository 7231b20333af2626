#pragma once
/// Topics between the nodelets of one manager, relative to their namespace.

namespace slipnav {

inline constexpr const char* kInitialStateTopic = "initial_state";
inline constexpr const char* kInsStepsTopic = "ins_steps";
inline constexpr const char* kCorrectionTopic = "correction";
/// Filter to Initializer, latched: slipnav/StartState, the state once per second of sensor time, for a new start when
/// the filter is gone, and for an initializer that finds an estimate running. Not `known`: there is no estimate.
inline constexpr const char* kHandOverTopic = "hand_over";
/// Filter to Initializer: std_msgs/UInt32, the start whose first steps the filter has missed; it requests a new one.
inline constexpr const char* kStartRequestTopic = "start_request";
inline constexpr const char* kInitializationTopic = "initialization";
/// Filter to Forecast: slipnav/ForecastInput, one per wheel interval.
inline constexpr const char* kForecastInputTopic = "forecast_input";
/// Forecast to StopSupervisor: std_msgs/Header, stamp of the newest processed estimate. A forecast made with
/// it was published before.
inline constexpr const char* kForecastProgressTopic = "forecast_progress";
/// From a nodelet whose parameters were changed to all others: dynamic_reconfigure/Config, the new values.
inline constexpr const char* kTuningTopic = "tuning";
/// Overlay to the rviz panel: std_msgs/String, distance, error and 3σ in one line.
inline constexpr const char* kFiguresTopic = "figures";
/// Replay to rviz, latched: visualization_msgs/MarkerArray, other systems' tracks on the same drive.
inline constexpr const char* kComparedTopic = "compared";
/// Overlay to robot_state_publisher: the wheels of the model in rviz.
inline constexpr const char* kModelJointsTopic = "model/joint_states";

}  // namespace slipnav
