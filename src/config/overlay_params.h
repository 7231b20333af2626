#pragma once
/// How the overlay is drawn.

#include <string>

#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Block `overlay`.
struct OverlayParams {
  double publish_period_s = 0.5;
  double point_spacing_m = 0.1;
  int max_points = 4000;
  int max_stops = 200;
  bool flat = true;
  double slip_full_scale = 0.3;
  double text_height_m = 0.7;
  std::string frame = "overlay";
  double legend_east_m = 5.0;
  double legend_north_m = 12.5;
  void visit(ParameterVisitor& v);
};

}  // namespace slipnav
