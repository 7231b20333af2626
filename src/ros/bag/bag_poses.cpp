#include "ros/bag/bag_poses.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>

#include <optional>
#include <stdexcept>

#include "ros/bag/bag_file.h"

namespace slipnav {
namespace {

std::string bare(const std::string& topic) { return topic.empty() || topic.front() != '/' ? topic : topic.substr(1); }

template <class Point, class Orientation>
TumPose pose(const ros::Time& stamp, const Point& point, const Orientation& orientation) {
  return {static_cast<Nanoseconds>(stamp.toNSec()), Vector3(point.x, point.y, point.z),
          Quaternion(orientation.w, orientation.x, orientation.y, orientation.z)};
}

std::optional<TumPose> poseOf(BagParts& bag, const BagEntry& entry) {
  if (bag.holds<nav_msgs::Odometry>(entry)) {
    const auto message = bag.read<nav_msgs::Odometry>(entry);
    return pose(message.header.stamp, message.pose.pose.position, message.pose.pose.orientation);
  }
  if (bag.holds<geometry_msgs::PoseStamped>(entry)) {
    const auto message = bag.read<geometry_msgs::PoseStamped>(entry);
    return pose(message.header.stamp, message.pose.position, message.pose.orientation);
  }
  if (bag.holds<geometry_msgs::PoseWithCovarianceStamped>(entry)) {
    const auto message = bag.read<geometry_msgs::PoseWithCovarianceStamped>(entry);
    return pose(message.header.stamp, message.pose.pose.position, message.pose.pose.orientation);
  }
  if (bag.holds<geometry_msgs::TransformStamped>(entry)) {
    const auto message = bag.read<geometry_msgs::TransformStamped>(entry);
    return pose(message.header.stamp, message.transform.translation, message.transform.rotation);
  }
  return std::nullopt;
}

bool isPose(const TumPose& pose) {
  return pose.position_enu_m.allFinite() && pose.q_flu_to_enu.coeffs().allFinite() && pose.q_flu_to_enu.norm() > 0.5;
}

std::string typeOf(const BagParts& bag, const std::string& topic) {
  for (const BagConnection& connection : bag.connections()) {
    if (bare(connection.topic) == bare(topic)) {
      return connection.type;
    }
  }
  return "";
}

}  // namespace

std::vector<TumPose> readPoses(const std::vector<std::string>& paths, const std::string& topic) {
  BagParts bag(paths);
  const std::string type = typeOf(bag, topic);
  if (type.empty()) {
    throw std::invalid_argument(paths.front() + ": no topic '" + topic + "' to compare with");
  }
  std::vector<TumPose> poses;
  poses.reserve(bag.entries().size());
  for (const BagEntry& entry : bag.entries()) {
    if (bare(bag.connection(entry).topic) != bare(topic)) {
      continue;
    }
    const std::optional<TumPose> found = poseOf(bag, entry);
    if (!found) {
      throw std::invalid_argument(paths.front() + ": '" + topic + "' is of type " + type +
                                  ", which is not one of nav_msgs/Odometry, geometry_msgs/PoseStamped, "
                                  "geometry_msgs/PoseWithCovarianceStamped, geometry_msgs/TransformStamped");
    }
    if (isPose(*found)) {
      poses.push_back({found->stamp, found->position_enu_m, found->q_flu_to_enu.normalized()});
    }
  }
  return poses;
}

}  // namespace slipnav
