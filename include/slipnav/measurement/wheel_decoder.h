#pragma once
/// Wheel rates from arrays of named joints, as sensor_msgs/JointState has them.

#include <optional>
#include <string>
#include <vector>

#include "slipnav/measurement/wheel_geometry.h"
#include "slipnav/sensors.h"

namespace slipnav {

/// One message: arrays are empty or as long as `names`. With no names at all, values stand in the order of the
/// configured wheels, and so they do for wheels that are configured without a name.
struct JointArrays {
  Nanoseconds stamp = 0;
  const std::vector<std::string>& names;
  const std::vector<double>& position_rad;
  const std::vector<double>& velocity_radps;
};

/// Finds the configured wheels in each message, and remembers the one before to difference positions.
class WheelDecoder {
 public:
  /// @param max_speed_mps a wheel that goes faster at its circumference has not been read rightly
  WheelDecoder(std::vector<WheelParams> wheels, double max_speed_mps)
      : wheels_(std::move(wheels)), max_speed_mps_(max_speed_mps) {}

  /// Rates by the velocities, or where there are none by the difference of positions to the message before; positive
  /// forward. Nothing for a message that cannot be used, with the reason in problem(), and nothing without a problem
  /// for the first of a series of positions and for messages of other joints. A message that cannot be used leaves the
  /// decoder as it was, but for one whose positions have jumped, as those of an encoder that has overflowed: the next
  /// is differenced to it.
  ///
  /// Positions serve as well where velocities are not finite, or are always zero while the positions move. Positions
  /// that never leave one turn (-π to π, or 0 to 2π) are taken to wrap: of the two ways between them the shorter one
  /// counts.
  std::optional<WheelSample> decode(const JointArrays& joints);

  /// What was wrong with the last message, "" when nothing.
  const std::string& problem() const { return problem_; }

  /// What is to be said once about what the messages are like, with the first message that shows it; else "".
  const std::string& remark() const { return remark_; }

  /// Forgets the positions of the message before.
  void reset() { last_.reset(); }

 private:
  bool locate(const JointArrays& joints);
  bool isOfOtherJoints(const JointArrays& joints);
  bool hasVelocities(const JointArrays& joints) const;
  std::optional<WheelSample> insteadOfStanding(const JointArrays& joints, const WheelSample& rates);
  void noteRange(const WheelSample& angles);
  void usePositions(const std::string& why);
  double turned(double from_rad, double to_rad) const;
  std::optional<WheelSample> pick(const JointArrays& joints, const std::vector<double>& values, const char* what);
  std::optional<WheelSample> fromPositions(const JointArrays& joints);
  std::optional<WheelSample> possible(const WheelSample& rates, const char* what);

  std::vector<WheelParams> wheels_;
  double max_speed_mps_;
  std::vector<std::string> names_;    ///< of the message that `indices_` belongs to
  std::vector<std::size_t> indices_;  ///< where each wheel stands in the arrays
  std::optional<WheelSample> last_;   ///< angles [rad] in place of rates
  double interval_s_ = 0.0;           ///< between the last two positions
  bool by_positions_ = false;         ///< the velocities have turned out to be of no use
  bool velocity_seen_ = false;        ///< one that is not zero
  double turned_rad_ = 0.0;           ///< by positions, while all velocities were zero
  int other_joints_ = 0;              ///< messages without any of the wheels, before the first with them
  bool beyond_minus_pi_ = false;      ///< a position has been below -π
  bool beyond_zero_ = false;          ///< below 0
  bool beyond_pi_ = false;            ///< above π
  bool beyond_two_pi_ = false;        ///< above 2π
  std::string remark_;
  std::string problem_;
};

}  // namespace slipnav
