#include "ros/rviz/compared_tracks.h"

#include <array>

#include "ros/rviz/marker_builder.h"

namespace slipnav {
namespace {

constexpr double kWidth_m = 0.2;
constexpr double kTextHeight_m = 1.2;
/// Above the other tracks.
constexpr double kHeight_m = 0.3;
/// Ten poses a second are more than a screen shows.
constexpr Nanoseconds kSpacing = kSecond / 10;
constexpr std::array<Color, 3> kColors = {kStopColor, kSafeColor, kTextColor};

std::vector<Vector3> pointsOf(const EstimateTrack& track) {
  std::vector<Vector3> points;
  Nanoseconds newest = 0;
  for (const EstimateSample& pose : track) {
    if (points.empty() || pose.stamp - newest >= kSpacing) {
      points.push_back(pose.position_enu_m + kHeight_m * Vector3::UnitZ());
      newest = pose.stamp;
    }
  }
  return points;
}

}  // namespace

visualization_msgs::MarkerArray comparedTracks(const std::vector<OtherTrack>& tracks, const std::string& map_frame) {
  MarkerBuilder sketch(map_frame, 0, true);
  int id = 0;
  for (const OtherTrack& track : tracks) {
    const Color& color = kColors[static_cast<std::size_t>(id) % kColors.size()];
    const std::vector<Vector3> points = pointsOf(track.estimates);
    sketch.line(track.name, id, points, kWidth_m, color);
    ++id;
    const Vector3 above =
        points.back() + id * kTextHeight_m * Vector3::UnitY();  // several tracks end at the same place
    sketch.text(track.name + " name", id, above, kTextHeight_m, color, track.name);
  }
  return sketch.markers();
}

}  // namespace slipnav
