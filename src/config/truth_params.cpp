#include "config/truth_params.h"

namespace slipnav {

void TruthParams::visit(ParameterVisitor& v) {
  v.choice("align", align, {"auto", "none", "start_yaw", "start_pose", "heading"},
           "none: truth is in the frame of the estimate; start_yaw, start_pose: its first pose is put on that of the "
           "estimate, by heading or by full attitude; heading: rotated to fit the first meters; auto: none for fixes, "
           "start_yaw for poses");
  v.number("heading_distance_m", heading_distance_m, {1.0, 1e4}, "distance over which align: heading fits [m]");
  v.number("stamp_offset_s", stamp_offset_s, {-3600.0, 3600.0},
           "added to the stamps of the truth, for a receiver with another time scale [s]");
}

TruthAlignment TruthParams::alignment(bool geodetic) const {
  TruthAlignment alignment;
  if (align == "start_pose") {
    alignment.at_start = StartAlignment::kFullPose;
  } else if (align == "start_yaw" || (align == "auto" && !geodetic)) {
    alignment.at_start = StartAlignment::kYaw;
  } else if (align == "heading") {
    alignment.heading_distance_m = heading_distance_m;
  }
  return alignment;
}

}  // namespace slipnav
