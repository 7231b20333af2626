#include "ros/rviz/marker_builder.h"

#include "ros/messages/conversions.h"

namespace slipnav {

std_msgs::ColorRGBA toMessage(const Color& color) {
  std_msgs::ColorRGBA message;
  message.r = color.red;
  message.g = color.green;
  message.b = color.blue;
  message.a = color.alpha;
  return message;
}

geometry_msgs::Point toPoint(const Vector3& position) {
  geometry_msgs::Point point;
  point.x = position.x();
  point.y = position.y();
  point.z = position.z();
  return point;
}

MarkerBuilder::MarkerBuilder(const std::string& frame_id, Nanoseconds stamp, bool locked) : locked_(locked) {
  header_.frame_id = frame_id;
  header_.stamp = toRosTime(stamp);
}

visualization_msgs::Marker& MarkerBuilder::add(const std::string& name, int id, int type, double width_m,
                                               const Color& color) {
  visualization_msgs::Marker& marker = markers_.markers.emplace_back();
  marker.header = header_;
  marker.frame_locked = static_cast<std::uint8_t>(locked_);
  marker.ns = name;
  marker.id = id;
  marker.type = type;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  const bool is_surface = type == visualization_msgs::Marker::TRIANGLE_LIST;
  marker.scale.x = is_surface ? 1.0 : width_m;
  marker.scale.y = is_surface ? 1.0 : 0.0;
  marker.scale.z = is_surface ? 1.0 : 0.0;
  marker.color = toMessage(color);
  return marker;
}

void MarkerBuilder::line(const std::string& name, int id, const std::vector<Vector3>& points, double width_m,
                         const Color& color) {
  visualization_msgs::Marker& marker = add(name, id, visualization_msgs::Marker::LINE_STRIP, width_m, color);
  marker.points.reserve(points.size());
  for (const Vector3& point : points) {
    marker.points.push_back(toPoint(point));
  }
}

void MarkerBuilder::text(const std::string& name, int id, const Vector3& position, double height_m, const Color& color,
                         const std::string& words) {
  visualization_msgs::Marker& marker = add(name, id, visualization_msgs::Marker::TEXT_VIEW_FACING, 0.0, color);
  marker.pose.position = toPoint(position);
  marker.scale.z = height_m;
  marker.text = words;
}

void MarkerBuilder::disc(const std::string& name, int id, const Vector3& position, double diameter_m,
                         const Color& color) {
  constexpr double kThickness_m = 0.02;
  visualization_msgs::Marker& marker = add(name, id, visualization_msgs::Marker::CYLINDER, diameter_m, color);
  marker.pose.position = toPoint(position);
  marker.scale.y = diameter_m;
  marker.scale.z = kThickness_m;
}

}  // namespace slipnav
