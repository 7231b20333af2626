#pragma once
/// The vehicle's motion from its wheels, in whatever unit is known.

#include <string>
#include <vector>

#include "inspection/recording.h"
#include "inspection/wheel_choice.h"

namespace slipnav {

/// Means over one interval.
struct WheelRow {
  double time_s = 0.0;  ///< of the middle of the interval
  double interval_s = 0.0;
  double speed = 0.0;    ///< forward; [m/s], or [rad/s] if no radius is known
  double turn = 0.0;     ///< positive left: right less left in the unit of speed, or the heading rate [rad/s]
  double largest = 0.0;  ///< of the magnitudes of all wheels
};

/// What a track can be trusted for.
struct WheelTrack {
  std::string topic;
  bool in_meters = false;  ///< speed is in m/s
  bool has_turn = false;
  bool turn_is_rate = false;   ///< turn is a heading rate, as reported by odometry
  double rest_speed = 0.0;     ///< slower is at rest
  double interval_s = 0.0;     ///< usual one
  std::vector<WheelRow> rows;  ///< in order of time
};

/// Whether the speed is ever negative.
bool hasSign(const WheelTrack& track);

/// Rates of each wheel as in the messages, no signs changed, and the decoder's remarks.
struct JointRates {
  std::vector<WheelSample> samples;  ///< stamps relative to the origin, in continuous time
  std::vector<std::string> remarks;
  std::vector<std::string> problems;  ///< each once
};

JointRates ratesOf(const JointRecord& record, const std::vector<WheelJoint>& wheels, Nanoseconds origin);

/// Gives each wheel the sign that makes it turn like the others, and all of them the one that makes the vehicle drive
/// forward for most of its distance.
void chooseSigns(const JointRates& rates, std::vector<WheelJoint>& wheels);

WheelTrack trackOf(const JointRates& rates, const std::vector<WheelJoint>& wheels);
WheelTrack trackOf(const PoseRecord& odometry, Nanoseconds origin);

}  // namespace slipnav
