#pragma once
/// How a recorded truth is aligned with the estimate.

#include <optional>
#include <string>

#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// How the start pose of the truth is matched to that of the estimate.
enum class StartAlignment {
  kYaw,      ///< position and heading: for a level truth frame (z up), such as odometry or a leveled arena
  kFullPose  ///< position and full attitude: for truth in the robot's own start frame, tilted as the robot was
};

/// How truth is aligned with the estimate.
struct TruthAlignment {
  std::optional<StartAlignment> at_start;    ///< for truth in its own frame
  std::optional<double> heading_distance_m;  ///< rotate truth to fit the first meters, for fixes too poor for more
};

/// Block `truth`.
struct TruthParams {
  std::string align = "auto";
  double heading_distance_m = 30.0;
  double stamp_offset_s = 0.0;
  void visit(ParameterVisitor& v);

  /// @param geodetic the truth has latitude and longitude; otherwise it is in its own frame
  TruthAlignment alignment(bool geodetic) const;
};

}  // namespace slipnav
