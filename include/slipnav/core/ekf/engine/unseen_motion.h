#pragma once
/// What a vehicle may have done while its IMU was silent, as covariance.

#include "slipnav/core/ekf/engine/filter_params.h"
#include "slipnav/core/ekf/error_state.h"

namespace slipnav {

/// Widens the covariance at the end of a gap, and again when it shows that this was not enough.
class UnseenMotion {
 public:
  explicit UnseenMotion(const FilterParams& params) : params_(params) {}

  /// There was no gap.
  void reset() { doubt_ = Doubt{}; }

  /// A gap of `gap_s` ends at `state`: what is known of attitude, velocity and position becomes less certain. A vehicle
  /// speeds up for a while, and then goes as fast as it does.
  /// @param fastest_mps the fastest that its wheels have turned; 0 before they have
  void begin(const NavigationState& state, double gap_s, double fastest_mps, ErrorCovariance& P);

  /// The wheels were silent as well: it may be that no time has passed, only the clock was set, and that the vehicle
  /// has not gone the way from `before` to `after`.
  static void allowForStandstill(const NavigationState& before, const NavigationState& after, ErrorCovariance& P);

  /// A wheel speed contradicts: if that is soon after a gap, what was learned of tilt and velocity since is doubted.
  void doubt(Nanoseconds stamp, ErrorCovariance& P);

  /// Zero velocity has been measured. Where it contradicts, which no slip explains, tilt and velocity are not known, if
  /// the gap is not yet settled; when it has been agreed to for a while, the gap is settled for good. The first
  /// agreement is not enough: after it, what far too large an error has left in linear terms is held for known.
  void standstill(bool agrees, ErrorCovariance& P);

 private:
  /// What a gap has left open.
  struct Doubt {
    double tilt_variance = 0.0;       ///< [rad²]
    double speed_variance = 0.0;      ///< [m²/s²]
    Nanoseconds by_wheels_until = 0;  ///< wheel speeds that contradict count until then
    int agreements = 0;               ///< of standstills in a row
  };

  void widen(ErrorCovariance& P) const;

  FilterParams params_;
  Doubt doubt_;
};

}  // namespace slipnav
