#include "slipnav/core/ekf/engine/filter_params.h"

#include <algorithm>

namespace slipnav {

void FilterParams::visit(ParameterVisitor& v) {
  v.words("updates", updates, {"wheel", "nonholonomic", "zupt", "zaru"},
          "measurements that correct the state; an empty list is free inertial navigation");
  v.number("gate_alpha", gate_alpha, {1e-12, 0.5},
           "probability with which a good measurement fails the innovation gate");
  v.number("zero_velocity_gate_alpha", zero_velocity_gate_alpha, {1e-12, 0.5},
           "the same for zero velocity and zero rate, on which encoders and IMU already agree");
  v.number("max_rejection_s", max_rejection_s, {0.0, 1e6},
           "after a wheel or constraint measurement contradicts for this long, the covariance is inflated [s]");
  v.number("max_standstill_doubt_s", max_standstill_doubt_s, {0.0, 60.0},
           "the same for a standstill that encoders and IMU agree on [s]");
  v.number("max_wait_s", max_wait_s, {0.0, 10.0}, "how long a step waits for a late wheel sample [s]");
  v.number("max_wheel_interval_s", max_wheel_interval_s, {0.01, 10.0},
           "a longer interval between wheel samples is a gap and not used [s]");
  v.number("gap_rate_std_deg_per_s", gap_rate_std_deg_per_s, {0.0, 1e3},
           "1σ of the mean angular rate in a gap of the IMU [°/s]");
  v.number("gap_accel_std_mps2", gap_accel_std_mps2, {0.0, 100.0},
           "1σ of the mean acceleration in a gap of the IMU [m/s²]");
  v.number("gap_max_tilt_deg", gap_max_tilt_deg, {0.0, 90.0},
           "largest 1σ added to roll and pitch by a gap, however long [°]");
  v.group("adaptation", adaptation, "how the noise of wheels, ground and IMU is learned while driving");
}

bool FilterParams::uses(const std::string& update) const {
  return std::find(updates.begin(), updates.end(), update) != updates.end();
}

}  // namespace slipnav
