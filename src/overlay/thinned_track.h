#pragma once
/// A track for display that never grows beyond its capacity.

#include <algorithm>
#include <cstddef>
#include <vector>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Points at least `spacing` apart, and always the newest one. When the capacity is reached every second point is
/// dropped and the spacing doubles, so that a drive of any length keeps its shape.
/// @tparam Point has a member `position_enu_m`
template <class Point>
class ThinnedTrack {
 public:
  /// @param capacity largest number of points, at least 4
  ThinnedTrack(double spacing_m, std::size_t capacity)
      : first_spacing_m_(spacing_m), spacing_m_(spacing_m), capacity_(std::max<std::size_t>(capacity, 4)) {}

  void clear() {
    points_.clear();
    spacing_m_ = first_spacing_m_;
  }

  void add(const Point& point) {
    if (newestMayGo()) {
      points_.back() = point;
      return;
    }
    if (points_.size() == capacity_) {
      thin();
    }
    points_.push_back(point);
  }

  const std::vector<Point>& points() const { return points_; }
  double spacing() const { return spacing_m_; }  ///< [m]

 private:
  /// The newest point is kept permanently once it is far enough from the previous one.
  bool newestMayGo() const {
    const std::size_t n = points_.size();
    return n >= 2 && (points_[n - 1].position_enu_m - points_[n - 2].position_enu_m).norm() < spacing_m_;
  }

  void thin() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points_.size(); i += 2) {
      points_[kept++] = points_[i];
    }
    points_.resize(kept);
    spacing_m_ *= 2.0;
  }

  double first_spacing_m_;
  double spacing_m_;
  std::size_t capacity_;
  std::vector<Point> points_;
};

}  // namespace slipnav
