#pragma once
/// Assumptions of the calibration about the drive.

#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Block `calibration`.
struct CalibrationParams {
  double firm_distance_m = 12.0;
  double firm_slip_std = 0.0005;
  double batch_m = 10.0;
  double truth_std_m = 0.005;
  void visit(ParameterVisitor& v);
};

}  // namespace slipnav
