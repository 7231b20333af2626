#pragma once
/// Possible motion of the vehicle while its IMU was silent, as covariance.

#include "slipnav/core/ekf/engine/filter_params.h"
#include "slipnav/core/ekf/error_state.h"

namespace slipnav {

/// Widens the covariance at the end of a gap, and again if that proves not enough.
class ImuGapUncertainty {
 public:
  explicit ImuGapUncertainty(const FilterParams& params) : params_(params) {}

  /// There is no gap to account for.
  void reset() { doubt_ = Doubt{}; }

  /// A gap of `gap_s` ends at `state`: attitude, velocity and position become less certain. The vehicle is assumed to
  /// accelerate for a while, up to a limit, and then to keep its speed.
  /// @param fastest_mps the fastest wheel speed so far; 0 before the wheels have turned
  void begin(const NavigationState& state, double gap_s, double fastest_mps, ErrorCovariance& P);

  /// The wheels were silent as well: possibly no time has passed, only the clock was set, and the vehicle
  /// has not moved from `before` to `after`.
  static void allowForStandstill(const NavigationState& before, const NavigationState& after, ErrorCovariance& P);

  /// A wheel speed contradicts: soon after a gap, tilt and velocity are widened again.
  void doubt(Nanoseconds stamp, ErrorCovariance& P);

  /// Zero velocity has been measured. If it contradicts before the gap is settled, tilt and velocity are widened again,
  /// since no slip explains it. The gap is settled once standstill has been accepted several times in a row; a single
  /// time is not enough, because after an error far outside the linear range the covariance is too small.
  void standstill(bool agrees, ErrorCovariance& P);

 private:
  /// What a gap has left uncertain.
  struct Doubt {
    double tilt_variance = 0.0;       ///< [rad²]
    double speed_variance = 0.0;      ///< [m²/s²]
    Nanoseconds by_wheels_until = 0;  ///< contradicting wheel speeds count until then
    int agreements = 0;               ///< standstills accepted in a row
  };

  void widen(ErrorCovariance& P) const;

  FilterParams params_;
  Doubt doubt_;
};

}  // namespace slipnav
