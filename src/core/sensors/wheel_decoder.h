#pragma once
/// Wheel rates from arrays of named joints, as in sensor_msgs/JointState.

#include <optional>
#include <string>
#include <vector>

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/sensors/wheel_geometry.h"

namespace slipnav {

/// One message: arrays are empty or as long as `names`. Without names, values are in the order of the
/// configured wheels, as they are for wheels configured without a name.
struct JointArrays {
  Nanoseconds stamp = 0;
  const std::vector<std::string>& names;
  const std::vector<double>& position_rad;
  const std::vector<double>& velocity_radps;
};

/// Finds the configured wheels in each message, and remembers the previous one to difference positions.
class WheelDecoder {
 public:
  /// @param max_speed_mps a faster circumferential speed is a reading error
  WheelDecoder(std::vector<WheelParams> wheels, double max_speed_mps)
      : wheels_(std::move(wheels)), max_speed_mps_(max_speed_mps) {}

  /// Rates from the velocities, or without velocities from the difference of positions to the previous message;
  /// positive forward. Nothing for an unusable message, with the reason in problem(), and nothing without a problem for
  /// the first of a series of positions and for messages of other joints. An unusable message leaves the decoder
  /// unchanged, except when its positions have jumped, like those of an encoder that has overflowed: the next one is
  /// differenced to it.
  ///
  /// Positions are also used for a message whose velocities are not finite, and once these have been zero while the
  /// positions moved. Positions that never leave one turn (-π to π, or 0 to 2π) are assumed to wrap: of the two ways
  /// between them the shorter one counts. A message that is a second older than its predecessors restarts the decoder.
  std::optional<WheelSample> decode(const JointArrays& joints);

  /// What was wrong with the last message, otherwise "".
  const std::string& problem() const { return problem_; }

  /// A remark on what the messages are like, reported once, with the first message that shows it; otherwise "".
  const std::string& remark() const { return remark_; }

 private:
  /// What the messages have been like since the clock started.
  struct Seen {
    Nanoseconds newest = 0;
    std::optional<WheelSample> angles;  ///< of the previous message [rad], in place of rates
    double interval_s = 0.0;            ///< between the last two positions
    double turned_rad = 0.0;            ///< by positions, while all velocities were zero
    bool velocity = false;              ///< one that is not zero
    bool filled_in = false;             ///< the velocities have turned out to be of no use
    bool not_finite = false;            ///< a velocity
    bool beyond_minus_pi = false;       ///< a position has been below -π
    bool beyond_zero = false;           ///< below 0
    bool beyond_pi = false;             ///< above π
    bool beyond_two_pi = false;         ///< above 2π
  };

  bool locate(const JointArrays& joints);
  bool isOfOtherJoints(const JointArrays& joints);
  bool areFinite(const JointArrays& joints) const;
  bool areFilledIn(const WheelSample& rates, const std::optional<WheelSample>& by_position);
  void noteRange(const WheelSample& angles);
  double turned(double from_rad, double to_rad) const;
  std::optional<WheelSample> pick(const JointArrays& joints, const std::vector<double>& values, const char* what);
  std::optional<WheelSample> fromPositions(const JointArrays& joints);
  std::optional<WheelSample> possible(const WheelSample& rates, const char* what);

  std::vector<WheelParams> wheels_;
  double max_speed_mps_;
  std::vector<std::string> names_;    ///< of the message that `indices_` belongs to
  std::vector<std::size_t> indices_;  ///< position of each wheel in the arrays
  Seen seen_;
  int other_joints_ = 0;  ///< messages without any of the wheels, before the first with them
  std::string remark_;
  std::string problem_;
};

}  // namespace slipnav
