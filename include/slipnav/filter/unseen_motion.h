#pragma once
/// What a vehicle may have done while its IMU was silent, as covariance.

#include "slipnav/filter/error_state.h"
#include "slipnav/filter/filter_params.h"

namespace slipnav {

/// Widens the covariance at the end of a gap, and again when it shows that this was not enough.
class UnseenMotion {
 public:
  explicit UnseenMotion(const FilterParams& params) : params_(params) {}

  /// Nothing is unsettled any more.
  void settle() { settled_at_ = 0; }

  /// A gap of `gap_s` ends at `state`: what is known of attitude, velocity and position becomes less certain.
  void begin(const NavigationState& state, double gap_s, ErrorCovariance& P);

  /// A measurement contradicts: if that is soon after a gap, what was learned of tilt and velocity since is doubted.
  void doubt(Nanoseconds stamp, ErrorCovariance& P);

 private:
  void widen(ErrorCovariance& P) const;

  FilterParams params_;
  double tilt_variance_ = 0.0;   ///< [rad²]
  double speed_variance_ = 0.0;  ///< [m²/s²]
  Nanoseconds settled_at_ = 0;
};

}  // namespace slipnav
