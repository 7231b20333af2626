#include "config/calibration_params.h"

namespace slipnav {

void CalibrationParams::visit(ParameterVisitor& v) {
  v.number("firm_distance_m", firm_distance_m, {1.0, 1e6},
           "how far the drive begins on firm, level ground, where wheels hardly slip: the radii come from there [m]");
  v.number("firm_slip_std", firm_slip_std, {0.0, 0.1},
           "1σ of the slip that even the firm ground has, a ratio of speed");
  v.number("batch_m", batch_m, {1.0, 1e4},
           "stretches of the drive so long count as independent; slip should forget itself well within one [m]");
  v.number("truth_std_m", truth_std_m, {1e-5, 100.0},
           "least 1σ of a truth position on each axis, for truth that says nothing of it [m]");
}

}  // namespace slipnav
