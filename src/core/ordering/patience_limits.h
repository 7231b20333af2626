#pragma once
/// How long silence must last in real time before it counts.

namespace slipnav {

/// [s] of the wall clock, on a rover.
inline constexpr double kPatience_s = 0.2;
/// [s] of the wall clock, where time is that of a recording or a simulation: on a busy machine
/// a message may take long, and no rover is waiting.
inline constexpr double kSimulatedPatience_s = 2.0;

}  // namespace slipnav
