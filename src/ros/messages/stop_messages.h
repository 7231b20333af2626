#pragma once
/// Between the stop supervisor and the messages around it.

#include <geometry_msgs/Twist.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>
#include <slipnav/StopStatus.h>

#include "config/frames.h"
#include "core/stopping/stop_supervisor.h"

namespace slipnav {

/// All six components unchanged: the supervisor works in any axes.
VelocityCommand toVelocityCommand(const geometry_msgs::Twist& message);
geometry_msgs::Twist toTwist(const VelocityCommand& command);

void fill(const SupervisorStatus& status, StopMode mode, const FrameNames& frames, StopStatus& message);

/// Derives observations from nav_state and slip: the same as observationOf() from the original estimate,
/// except for the rounding of a rotated covariance.
class RoverObserver {
 public:
  /// @param wheel_speed_at_rest_mps highest circumferential speed of a wheel at rest, see StationaryParams
  explicit RoverObserver(double wheel_speed_at_rest_mps) : wheel_speed_at_rest_mps_(wheel_speed_at_rest_mps) {}

  void setWheelSpeedAtRest(double speed_mps) { wheel_speed_at_rest_mps_ = speed_mps; }

  /// The slip of an estimate comes before its nav_state.
  void add(const Slip& message);
  RoverObservation observe(const NavState& message);

 private:
  double wheel_speed_at_rest_mps_;
  double forward_mps_ = 0.0;
  bool wheels_at_rest_ = false;
  bool has_wheels_ = false;  ///< a wheel interval has ended since the last nav_state
};

}  // namespace slipnav
