#pragma once
/// What a vehicle may have done while its IMU was silent, as covariance.

#include "slipnav/earth/planet.h"
#include "slipnav/filter/error_state.h"
#include "slipnav/filter/filter_params.h"

namespace slipnav {

/// Widens the covariance at the end of a gap, and once more when the filter has settled after it.
class UnseenMotion {
 public:
  UnseenMotion(const Planet& planet, const FilterParams& params) : planet_(planet), params_(params) {}

  void reset() { turn_variance_ = 0.0; }

  /// A gap of `gap_s` ends at `state`: what is known of attitude, velocity and position becomes less certain.
  void begin(const NavigationState& state, double gap_s, ErrorCovariance& P);

  /// Adds the turn in the last gap once more when `state` is long enough after it. Heading cannot be observed; but the
  /// filter believes to observe it while tilt and speed are being found again, since each correction changes the point
  /// about which it is linear. What it has lost in this way it gets back when they have settled: as a rotation of
  /// attitude, velocity and way since the gap about the vertical, the direction that no measurement sees.
  void settle(const NavigationState& state, ErrorCovariance& P);

 private:
  Planet planet_;
  FilterParams params_;
  double turn_variance_ = 0.0;  ///< not yet added [rad²]
  NavigationState end_of_gap_;
};

}  // namespace slipnav
