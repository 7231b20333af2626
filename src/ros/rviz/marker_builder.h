#pragma once
/// Makes markers of one frame and stamp, one line each.

#include <visualization_msgs/MarkerArray.h>

#include <string>
#include <vector>

#include "overlay/palette.h"
#include "slipnav/core/base/types.h"

namespace slipnav {

std_msgs::ColorRGBA toMessage(const Color& color);
geometry_msgs::Point toPoint(const Vector3& position);

/// One rviz marker array in one frame, built shape by shape.
class MarkerBuilder {
 public:
  /// @param locked markers move with their frame between one publication and the next
  MarkerBuilder(const std::string& frame_id, Nanoseconds stamp, bool locked);

  /// All without points: a polyline, separate segments and triangles of the given width [m].
  visualization_msgs::Marker& add(const std::string& name, int id, int type, double width_m, const Color& color);

  void line(const std::string& name, int id, const std::vector<Vector3>& points, double width_m, const Color& color);
  /// Text that faces the viewer, centered.
  void text(const std::string& name, int id, const Vector3& position, double height_m, const Color& color,
            const std::string& words);
  /// Flat disc.
  void disc(const std::string& name, int id, const Vector3& position, double diameter_m, const Color& color);

  const visualization_msgs::MarkerArray& markers() const { return markers_; }

 private:
  std_msgs::Header header_;
  bool locked_;
  visualization_msgs::MarkerArray markers_;
};

}  // namespace slipnav
