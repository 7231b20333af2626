#include "ros/runtime/extrinsics.h"

#include <ros/time.h>
#include <tf2/exceptions.h>

#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

std::optional<MountParams> lookUp(const tf2::BufferCore& buffer, const std::string& base, const std::string& sensor) {
  try {
    const geometry_msgs::TransformStamped pose = buffer.lookupTransform(base, sensor, ros::Time(0));
    const geometry_msgs::Vector3& position = pose.transform.translation;
    const geometry_msgs::Quaternion& q = pose.transform.rotation;
    const Vector3 angles_rad = eulerFrom_q_b_to_n(Quaternion(q.w, q.x, q.y, q.z).normalized());
    return MountParams{position.x,
                       position.y,
                       position.z,
                       radToDeg(angles_rad.x()),
                       radToDeg(angles_rad.y()),
                       radToDeg(angles_rad.z())};
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

std::string missing(const std::string& base, const std::string& sensor) {
  return "no transform " + base + " → " + sensor;
}

}  // namespace

std::string takeExtrinsics(const tf2::BufferCore& buffer, bool with_gps, Config& config) {
  const FrameNames& frames = config.frames;
  const std::optional<MountParams> imu = lookUp(buffer, frames.base, frames.imu);
  if (!imu) {
    return missing(frames.base, frames.imu);
  }
  const std::optional<MountParams> gps = with_gps ? lookUp(buffer, frames.base, frames.gps) : config.gps_mount;
  if (!gps) {
    return missing(frames.base, frames.gps);
  }
  config.imu.mount = *imu;
  config.gps_mount = *gps;
  return "";
}

}  // namespace slipnav
