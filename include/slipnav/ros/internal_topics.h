#pragma once
/// Topics between the nodelets of one manager, relative to their namespace.

namespace slipnav {

inline constexpr const char* kInitialStateTopic = "initial_state";
inline constexpr const char* kInsStepsTopic = "ins_steps";
inline constexpr const char* kCorrectionTopic = "correction";
inline constexpr const char* kInitializationTopic = "initialization";

}  // namespace slipnav
