#pragma once
/// How a recorded truth is laid over the estimate.

#include <string>

#include "slipnav/config/parameter_visitor.h"
#include "slipnav/eval/alignment.h"

namespace slipnav {

/// Block `truth`.
struct TruthParams {
  std::string align = "auto";
  double heading_distance_m = 30.0;
  void visit(ParameterVisitor& v);

  /// @param geodetic the truth is known by latitude and longitude; otherwise it lives in a frame of its own
  TruthAlignment alignment(bool geodetic) const;
};

}  // namespace slipnav
