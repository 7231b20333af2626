#pragma once
/// Topics between the nodelets of one manager, relative to their namespace.

namespace slipnav {

inline constexpr const char* kInitialStateTopic = "initial_state";
inline constexpr const char* kInsStepsTopic = "ins_steps";
inline constexpr const char* kCorrectionTopic = "correction";
inline constexpr const char* kInitializationTopic = "initialization";
/// Overlay to robot_state_publisher: the wheels of the model in rviz.
inline constexpr const char* kModelJointsTopic = "model/joint_states";

}  // namespace slipnav
