#pragma once
/// How a recorded truth is laid over the estimate.

#include <optional>
#include <string>

#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// How the start pose of truth becomes the start pose of the estimate.
enum class StartAlignment {
  kYaw,      ///< position and heading: for a levelled truth frame (z up), such as odometry or a levelled arena
  kFullPose  ///< position and full attitude: for truth in the robot's own start frame, which leans as the robot did
};

/// How truth is laid over the estimate.
struct TruthAlignment {
  std::optional<StartAlignment> at_start;    ///< for truth in a frame of its own
  std::optional<double> heading_distance_m;  ///< turn truth to fit the first metres, for fixes too poor to tell more
};

/// Block `truth`.
struct TruthParams {
  std::string align = "auto";
  double heading_distance_m = 30.0;
  void visit(ParameterVisitor& v);

  /// @param geodetic the truth is known by latitude and longitude; otherwise it lives in a frame of its own
  TruthAlignment alignment(bool geodetic) const;
};

}  // namespace slipnav
