#include "ros/messages/start_reporter.h"

#include <boost/make_shared.hpp>
#include <cmath>
#include <cstdio>

#include "ros/messages/conversions.h"
#include "ros/runtime/internal_topics.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

std::string lineOf(const Initialization& report) {
  char line[300];
  std::snprintf(line, sizeof line,
                "initialization at %.3f s: %s; origin %.7f deg, %.7f deg, %.2f m, heading %.2f deg (1 sigma %.2f deg)",
                report.header.stamp.toSec(), report.progress.c_str(), report.latitude_deg, report.longitude_deg,
                report.height_m, report.heading_deg, report.heading_std_deg);
  return line;
}

}  // namespace

StartReporter::StartReporter(ros::NodeHandle& node, const FrameNames& frames)
    : frames_(frames), publisher_(SharedPublisher<Initialization>(node, kInitializationTopic, true)) {}

std::string StartReporter::search(const std::string& progress, Nanoseconds stamp) {
  if (progress == progress_) {
    return "";
  }
  progress_ = progress;
  const auto report = boost::make_shared<Initialization>();
  report->header.stamp = toRosTime(stamp);
  report->header.frame_id = frames_.map;
  report->progress = progress_;
  publisher_.publish(report);
  return "initialization: " + progress_;
}

std::string StartReporter::end(const InitialState& initial, const std::string& how) {
  progress_ = how;
  const auto report = boost::make_shared<Initialization>();
  report->header.stamp = toRosTime(initial.nav.stamp);
  report->header.frame_id = frames_.map;
  report->done = true;
  report->progress = how;
  report->latitude_deg = radToDeg(initial.origin.latitude_rad);
  report->longitude_deg = radToDeg(initial.origin.longitude_rad);
  report->height_m = initial.origin.height_m;
  report->heading_deg = radToDeg(eulerFrom_q_b_to_n(initial.nav.q_b_to_n).z());
  report->heading_std_deg = radToDeg(std::sqrt(initial.P(kAttitude + 2, kAttitude + 2)));
  if (frames_.publish_tf) {
    sendMapToOdom(report->header.stamp);
  }
  publisher_.publish(report);
  return lineOf(*report);
}

void StartReporter::sendMapToOdom(const ros::Time& stamp) {
  geometry_msgs::TransformStamped map_to_odom;
  map_to_odom.header.stamp = stamp;
  map_to_odom.header.frame_id = frames_.map;
  map_to_odom.child_frame_id = frames_.odom;
  map_to_odom.transform.rotation.w = 1.0;
  tf_.sendTransform(map_to_odom);
}

}  // namespace slipnav
