#pragma once
/// Published odometry as bytes, to check whether two runs are identical.

#include <nav_msgs/Odometry.h>

#include <cstdint>
#include <string>
#include <vector>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Serialized messages in order of arrival, without the sequence number of the header, which counts
/// messages of a publisher. When the clock goes back, earlier messages are dropped.
class OdometryLog {
 public:
  void add(nav_msgs::Odometry message);

  /// 0 before the first.
  Nanoseconds newestStamp() const { return newest_; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  /// Throws std::runtime_error that names the path.
  void write(const std::string& path) const;

 private:
  std::vector<std::uint8_t> bytes_;
  Nanoseconds newest_ = 0;
};

}  // namespace slipnav
