#pragma once
/// How long silence has to last in real time before it counts.

namespace slipnav {

/// [s] of the wall clock, on a rover.
inline constexpr double kPatience_s = 0.2;
/// [s] of the wall clock, where time is that of a recording or a simulation: on a machine that is busy with other
/// things a message may be on its way for long, and no rover waits.
inline constexpr double kSimulatedPatience_s = 2.0;

}  // namespace slipnav
