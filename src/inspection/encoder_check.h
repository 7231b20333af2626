#pragma once
/// Checks of the wheel joints: signs, wrap, resolution, velocities against positions, units.

#include "inspection/finding.h"
#include "inspection/mounting.h"
#include "inspection/wheel_track.h"

namespace slipnav {

/// Numbers of one joint over a recording.
struct EncoderPicture {
  bool has_position = false;
  bool has_velocity = false;
  bool velocity_always_zero = true;
  std::size_t velocity_not_finite = 0;
  double least_position_rad = 0.0;
  double greatest_position_rad = 0.0;
  double least_velocity_radps = 0.0;
  double resolution_rad = 0.0;       ///< step that all changes of position are multiples of; 0: none seen
  double velocity_step_radps = 0.0;  ///< likewise of velocities
  double velocity_ratio = 0.0;       ///< velocity over differenced position; 0: not known
  double turned_rad = 0.0;           ///< sum of the magnitudes of all changes of position
  bool wraps = false;                ///< positions stay within one turn while the wheel makes many
};

EncoderPicture pictureOf(const JointRecord& record, std::size_t joint);

void checkEncoders(const JointRecord& record, const std::vector<WheelJoint>& wheels, const JointRates& rates,
                   Findings& findings);

/// A speed without a sign: never negative, while wheels and IMU contradict each other on the direction now and then.
void checkDirection(const WheelTrack& wheels, const Mounting& mounting, Findings& findings);

}  // namespace slipnav
