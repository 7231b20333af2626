#include "ros/rviz/overlay_markers.h"

#include <algorithm>
#include <cmath>

#include "ros/messages/conversions.h"
#include "ros/rviz/marker_builder.h"
#include "ros/rviz/overlay_legend.h"

namespace slipnav {
namespace {

using visualization_msgs::Marker;

constexpr double kSigmas = 3.0;
constexpr double kThinLine_m = 0.06;
constexpr double kSlipWidth_m = 0.6;
constexpr double kStopDiameter_m = 0.9;
constexpr float kFanAlpha = 0.7F;
constexpr double kForecastLifetime_s = 5.0;
constexpr double kLifetimeOfNow_s = 3.0;  // by the ROS clock; some publishing periods

// Heights relative to the track that separate, seen from above, items at the same spot [m].
constexpr double kFanHeight_m = -0.10;
constexpr double kSlipHeight_m = -0.06;
constexpr double kStopHeight_m = -0.03;
constexpr double kLabelHeight_m = 1.0;

Vector3 raised(const Vector3& position, double by_m) { return position + Vector3(0.0, 0.0, by_m); }

std::vector<Vector3> raised(std::vector<Vector3> points, double by_m) {
  for (Vector3& point : points) {
    point.z() += by_m;
  }
  return points;
}

void drawSlip(const DriveView& picture, const OverlayParams& params, MarkerBuilder& sketch) {
  const std::vector<TrackPoint>& points = picture.track().points();
  if (points.size() < 2) {
    return;
  }
  Marker& marker = sketch.add("slip", 0, Marker::LINE_STRIP, kSlipWidth_m, kNoSlipColor);
  marker.points.reserve(points.size());
  marker.colors.reserve(points.size());
  for (const TrackPoint& point : points) {
    marker.points.push_back(toPoint(raised(point.position_enu_m, kSlipHeight_m)));
    marker.colors.push_back(toMessage(slipColor(point.slip.value_or(0.0), params.slip_full_scale)));
  }
}

void drawError(const DriveView& picture, MarkerBuilder& sketch) {
  const EstimateSample& newest = *picture.newest();
  sketch.line("ellipse", 0, errorEllipse(newest.position_enu_m, newest.covariance_enu_m2, kSigmas), kThinLine_m,
              kEstimateColor);
  if (const std::optional<TruthPair>& pair = picture.newestPair()) {
    sketch.line("error", 0, {pair->estimate.position_enu_m, pair->truth.position_enu_m}, kThinLine_m, kErrorColor);
  }
}

std::string stopWords(const LoggedStop& stop) {
  const bool by_truth = stop.before.true_m && stop.after.true_m;
  const double before_m = by_truth ? *stop.before.true_m : stop.before.bound_m;
  const double after_m = by_truth ? *stop.after.true_m : stop.after.bound_m;
  return std::to_string(stop.number) + ": " + formatted(stop.duration_s, 1) + " s\n" + (by_truth ? "" : "3 sigma ") +
         formatted(before_m, 2) + " > " + formatted(after_m, 2) + " m";
}

void drawStops(const DriveView& picture, const OverlayParams& params, MarkerBuilder& sketch) {
  constexpr double kTextRatio = 0.75;  // smaller than the legend
  for (const LoggedStop& stop : picture.stops().stops()) {
    sketch.disc("stops", stop.number, raised(stop.position_enu_m, kStopHeight_m), kStopDiameter_m,
                withAlpha(kStopColor, 0.8F));
    const Vector3 beside(0.0, kStopDiameter_m + params.text_height_m, kLabelHeight_m);
    sketch.text("stop labels", stop.number, stop.position_enu_m + beside, kTextRatio * params.text_height_m, kTextColor,
                stopWords(stop));
  }
}

void addTriangle(const FanSection& a, const FanSection& b, const FanSection& c, const std::array<Vector3, 3>& corners,
                 double threshold_m, Marker& marker) {
  const std::array<const FanSection*, 3> sections = {&a, &b, &c};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    marker.points.push_back(toPoint(raised(corners[i], kFanHeight_m)));
    marker.colors.push_back(toMessage(withAlpha(boundColor(sections[i]->bound_m / threshold_m), kFanAlpha)));
  }
}

void drawFanSurface(const std::vector<FanSection>& sections, double threshold_m, MarkerBuilder& sketch) {
  Marker& fan = sketch.add("forecast", 0, Marker::TRIANGLE_LIST, 0.0, withAlpha(kSafeColor, kFanAlpha));
  for (std::size_t i = 1; i < sections.size(); ++i) {
    const FanSection& a = sections[i - 1];
    const FanSection& b = sections[i];
    addTriangle(a, b, b, {a.right_enu_m, b.right_enu_m, b.left_enu_m}, threshold_m, fan);
    addTriangle(a, b, a, {a.right_enu_m, b.left_enu_m, a.left_enu_m}, threshold_m, fan);
  }
}

/// Where the bound is forecast to pass the threshold.
void drawStopAhead(const Course& course, const ErrorForecast& forecast, MarkerBuilder& sketch) {
  if (!std::isfinite(forecast.time_to_stop_s)) {
    return;
  }
  const std::vector<FanSection> at = forecastFan(course, {forecast.time_to_stop_s}, {forecast.threshold_m});
  sketch.line("stop ahead", 0, {at[0].left_enu_m, at[0].right_enu_m}, 2.0 * kThinLine_m, kLimitColor);
}

/// Drawings of the present disappear by themselves if this nodelet dies.
void limitLifetime(std::vector<Marker>& markers) {
  for (Marker& marker : markers) {
    const bool is_of_now = marker.ns == "forecast" || marker.ns == "horizon" || marker.ns == "stop ahead" ||
                           marker.ns == "ellipse" || marker.ns == "error";
    marker.lifetime = ros::Duration(is_of_now ? kLifetimeOfNow_s : 0.0);
  }
}

bool isCurrent(const ErrorForecast* forecast, const EstimateSample& newest) {
  return forecast != nullptr && forecast->threshold_m > 0.0 && !forecast->times_s.empty() &&
         forecast->times_s.size() == forecast->horizontal_bound_m.size() &&
         std::abs(toSeconds(newest.stamp - toNanoseconds(forecast->header.stamp))) < kForecastLifetime_s;
}

void drawForecast(const DriveView& picture, const ErrorForecast* forecast, MarkerBuilder& sketch) {
  if (!isCurrent(forecast, *picture.newest()) || !picture.course().known()) {
    return;
  }
  const Course& course = picture.course().course();
  const std::vector<FanSection> fan = forecastFan(course, forecast->times_s, forecast->horizontal_bound_m);
  if (fan.size() >= 2) {
    drawFanSurface(fan, forecast->threshold_m, sketch);
  }
  const FanSection& horizon = fan.back();
  sketch.line("horizon", 0, raised(circle(horizon.center_enu_m, horizon.bound_m), kFanHeight_m), kThinLine_m,
              boundColor(horizon.bound_m / forecast->threshold_m));
  drawStopAhead(course, *forecast, sketch);
}

}  // namespace

nav_msgs::Path toPath(const DisplayTrack& track, const std::string& frame_id) {
  nav_msgs::Path path;
  path.header.frame_id = frame_id;
  path.poses.reserve(track.points().size());
  for (const TrackPoint& point : track.points()) {
    geometry_msgs::PoseStamped& pose = path.poses.emplace_back();
    pose.header.frame_id = frame_id;
    pose.header.stamp = toRosTime(point.stamp);
    pose.pose.position = toPoint(point.position_enu_m);
    pose.pose.orientation.w = point.q_flu_to_enu.w();
    pose.pose.orientation.x = point.q_flu_to_enu.x();
    pose.pose.orientation.y = point.q_flu_to_enu.y();
    pose.pose.orientation.z = point.q_flu_to_enu.z();
  }
  if (!path.poses.empty()) {
    path.header.stamp = path.poses.back().header.stamp;
  }
  return path;
}

visualization_msgs::MarkerArray OverlayMarkers::make(const DriveView& picture, const OverlayMessages& messages) {
  const Nanoseconds stamp = picture.newest() ? picture.newest()->stamp : 0;
  MarkerBuilder sketch(frame_id_, stamp, false);
  MarkerBuilder beside_rover(params_.frame, stamp, true);
  if (picture.newest()) {
    drawSlip(picture, params_, sketch);
    drawStops(picture, params_, sketch);
    if (!messages.stale) {
      drawForecast(picture, messages.error_forecast.get(), sketch);
      drawError(picture, sketch);
    }
    drawLegend(params_, beside_rover);
  }
  visualization_msgs::MarkerArray array = sketch.markers();
  limitLifetime(array.markers);
  array.markers.insert(array.markers.end(), beside_rover.markers().markers.begin(),
                       beside_rover.markers().markers.end());
  std::set<Key> shown;
  for (const Marker& marker : array.markers) {
    shown.emplace(marker.ns, marker.id);
  }
  for (const Key& gone : shown_) {
    if (shown.count(gone) == 0) {
      Marker& deletion = array.markers.emplace_back();
      deletion.header.frame_id = frame_id_;
      deletion.ns = gone.first;
      deletion.id = gone.second;
      deletion.action = Marker::DELETE;
    }
  }
  shown_ = std::move(shown);
  return array;
}

}  // namespace slipnav
