#pragma once
/// A speed that no slip explains.
///
/// A vehicle moves as fast as its wheels turn, or slower; for a moment it may slide. An estimate that stays above
/// twice the fastest wheel speed ever while the wheels turn, or moves against them by a quarter of it, has lost its
/// tilt or a bias of its IMU, and its covariance is meaningless.

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Watches the speed of the estimate, and keeps what a restart needs: the specific force of the last seconds.
class RunawayWatch {
 public:
  void reset() { *this = RunawayWatch(); }

  /// @param f_ib_b specific force without any bias correction, mean of a step of `duration_s` [m/s²]
  void addImu(const Vector3& f_ib_b, double duration_s);

  /// @param wheels_mps largest circumferential speed of a wheel, over `interval_s` up to `stamp`
  /// @param speed_mps magnitude of the estimated velocity
  /// @param backward_mps the estimated velocity against the direction in which the wheels turn
  /// @return whether it has run away; true once, then not until it has for as long again
  bool addWheels(Nanoseconds stamp, double wheels_mps, double speed_mps, double backward_mps, double interval_s);

  /// The fastest wheel speed so far [m/s].
  double fastest_mps() const { return fastest_mps_; }
  /// Distance by which the estimate has left the wheels until it had run away, the last time [m].
  double wayBeyond_m() const { return way_beyond_m_; }
  /// Roll and pitch from the specific force of the last seconds, including motion and bias [rad].
  Vector2 level() const;
  /// 1σ of the error that the motion of such a vehicle causes in it [rad].
  /// @param gravity_mps2 on this planet
  double levelStd_rad(double gravity_mps2) const;

 private:
  Vector3 f_mean_b_ = Vector3::Zero();
  double averaged_s_ = 0.0;
  double fastest_mps_ = 0.0;
  double way_apart_m_ = 0.0;  ///< since its speed was last within half of that of the wheels
  double way_beyond_m_ = 0.0;
  Nanoseconds since_ = 0;  ///< beyond any slip from here on; 0: it is not
};

}  // namespace slipnav
