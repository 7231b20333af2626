#include "config/calibration_params.h"

namespace slipnav {

void CalibrationParams::visit(ParameterVisitor& v) {
  v.number("firm_distance_m", firm_distance_m, {1.0, 1e6},
           "length of firm, level ground at the start, where wheels hardly slip: the radii come from it [m]");
  v.number("firm_slip_std", firm_slip_std, {0.0, 0.1}, "1σ of the slip on firm ground, as a ratio of speed");
  v.number("batch_m", batch_m, {1.0, 1e4},
           "stretches of this length count as independent; slip must decorrelate well within one [m]");
  v.number("truth_std_m", truth_std_m, {1e-5, 100.0},
           "smallest 1σ of a truth position on each axis, also for truth without covariance [m]");
}

}  // namespace slipnav
