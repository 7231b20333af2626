#pragma once
/// Satellite positions from their topic.

#include <sensor_msgs/NavSatFix.h>

#include <optional>
#include <string>

#include "config/config.h"
#include "ros/messages/conversions.h"

namespace slipnav {

/// Every listener decides alike.
class FixInput {
 public:
  explicit FixInput(const Config& config)
      : topic_(config.topics.gps_fix), stamp_offset_(fromSeconds(config.initialization.fix_stamp_offset_s)) {}

  /// Nothing if the message has no usable fix; problem() says why if something is wrong with it.
  std::optional<GnssFix> take(const sensor_msgs::NavSatFix& message) {
    problem_ = complaintOf(message, topic_);
    std::optional<GnssFix> fix = problem_.empty() ? toGnssFix(message) : std::nullopt;
    if (fix) {
      fix->stamp += stamp_offset_;
    }
    return fix;
  }

  /// What was wrong with the last message in one line that names its topic, otherwise "".
  const std::string& problem() const { return problem_; }
  const std::string& topic() const { return topic_; }
  /// Added to the stamps of the receiver.
  Nanoseconds stampOffset() const { return stamp_offset_; }

 private:
  std::string topic_;
  Nanoseconds stamp_offset_;
  std::string problem_;
};

}  // namespace slipnav
