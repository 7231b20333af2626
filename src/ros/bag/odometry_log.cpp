#include "ros/bag/odometry_log.h"

#include <ros/serialization.h>

#include "core/base/atomic_file.h"
#include "ros/messages/conversions.h"

namespace slipnav {

void OdometryLog::add(nav_msgs::Odometry message) {
  const Nanoseconds stamp = toNanoseconds(message.header.stamp);
  if (stamp <= newest_ - kRestartBackstep) {
    bytes_.clear();
  }
  newest_ = stamp;
  message.header.seq = 0;
  const std::uint32_t length = ros::serialization::serializationLength(message);
  const std::size_t before = bytes_.size();
  bytes_.resize(before + length);
  ros::serialization::OStream stream(bytes_.data() + before, length);
  ros::serialization::serialize(stream, message);
}

void OdometryLog::write(const std::string& path) const {
  AtomicFile file(path);
  file.stream().write(reinterpret_cast<const char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
  file.commit();
}

}  // namespace slipnav
