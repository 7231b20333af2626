#pragma once
/// Which joints are wheels, and on which side, by their names and by how they turn.

#include <string>
#include <vector>

#include "inspection/recording.h"
#include "slipnav/core/sensors/wheel_geometry.h"

namespace slipnav {

/// Of the vehicle.
enum class Side { kUnknown, kLeft, kRight };

/// By the words in a name: "left", "right", and the usual abbreviations (fl, rr, l, r).
Side sideOf(const std::string& name);

/// A joint that drives the vehicle.
struct WheelJoint {
  std::size_t index = 0;  ///< in the arrays of its record
  std::string name;       ///< "" if messages have no names
  Side side = Side::kUnknown;
  double sign = 1.0;      ///< −1 if it counts backwards when the vehicle drives forward
  double radius_m = 0.0;  ///< 0: not known
  double y_m = 0.0;       ///< left of the middle; 0: not known
};

/// The joints of a record that are named like wheels; if there are none, those with a side; otherwise those that have
/// turned at all. Signs are not known yet.
std::vector<WheelJoint> wheelsByName(const JointRecord& record);

/// The configured wheels, with their geometry, that are in the record.
std::vector<WheelJoint> wheelsByConfiguration(const JointRecord& record, const std::vector<WheelParams>& wheels);

}  // namespace slipnav
