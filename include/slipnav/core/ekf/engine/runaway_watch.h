#pragma once
/// A speed that no slip explains.
///
/// A vehicle goes as fast as its wheels turn, or slower; for a moment it may slide. An estimate that stays at more than
/// twice the fastest that the wheels have ever turned, while they turn, has lost its level or a bias of its IMU, and
/// with them all that its covariance says of them.

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Watches the speed of the estimate, and keeps what a new beginning needs: the specific force of the last seconds.
class RunawayWatch {
 public:
  void reset() { *this = RunawayWatch(); }

  /// @param f_ib_b specific force without any correction of its bias, mean of a step of `duration_s` [m/s²]
  void addImu(const Vector3& f_ib_b, double duration_s);

  /// @param wheels_mps largest circumferential speed of a wheel, over `interval_s` up to `stamp`
  /// @param speed_mps size of the velocity by the estimate
  /// @return whether it has run away; once, until it has for as long again
  bool addWheels(Nanoseconds stamp, double wheels_mps, double speed_mps, double interval_s);

  /// The fastest that the wheels have turned [m/s].
  double fastest_mps() const { return fastest_mps_; }
  /// What the estimate has gone beyond that in the time it was too fast, the last time [m].
  double wayBeyond_m() const { return way_beyond_m_; }
  /// Roll and pitch by the specific force of the last seconds, with motion and bias in it [rad].
  Vector2 level() const;
  /// 1σ that the motion of such a vehicle leaves in it [rad].
  /// @param gravity_mps2 on this planet
  double levelStd_rad(double gravity_mps2) const;

 private:
  Vector3 f_mean_b_ = Vector3::Zero();
  double averaged_s_ = 0.0;
  double fastest_mps_ = 0.0;
  double way_beyond_m_ = 0.0;
  Nanoseconds since_ = 0;  ///< too fast from here on; 0: it is not
};

}  // namespace slipnav
