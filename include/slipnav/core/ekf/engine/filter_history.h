#pragma once
/// What the filter did in a drive, kept so that the drive can be run backwards when it is over (RtsSmoother).

#include <vector>

#include "slipnav/core/ekf/error_dynamics.h"
#include "slipnav/core/ekf/error_state.h"
#include "slipnav/core/ekf/rts_smoother.h"

namespace slipnav {

/// An epoch as all measurements of the drive together say it.
struct SmoothedState {
  NavigationState nav;
  VehicleState vehicle;
  Vector3 omega_ib_b = Vector3::Zero();  ///< mean rate of the step that ends here, free of the smoothed bias [rad/s]
  ErrorCovariance P = ErrorCovariance::Identity();  ///< about this state
};

/// A FilterEngine tells it each of its steps, see FilterEngine::keepHistory(). Ten epochs a second are kept, at 8 kB
/// each: 75 MB for a quarter of an hour, whatever the rates of the sensors, and as much again in smooth().
class FilterHistory {
 public:
  explicit FilterHistory(const Planet& planet) : planet_(planet) {}

  /// The filter has started, or started anew: what was before is dropped.
  void begin(const ErrorCovariance& P);

  void propagate(const ErrorTransition& transition) { smoother_.propagate(transition.matrix()); }
  void forget(int index) { smoother_.forget(index); }
  void advance(const ErrorCovariance& P) { smoother_.advance(P); }
  void correct(const ErrorVector& error, const ErrorReset& reset, const ErrorCovariance& P) {
    smoother_.correct(error, reset, P);
  }
  /// A step is done, with this as the filter's estimate at its end.
  void endStep(const NavigationState& nav, const VehicleState& vehicle, const Vector3& omega_ib_b,
               const ErrorCovariance& P);

  /// The epochs that were kept, in order; the last one is the filter's own estimate after its last step. Empty before
  /// the first step.
  std::vector<SmoothedState> smooth();

 private:
  /// What the filter said at the end of a step.
  struct Epoch {
    NavigationState nav;
    VehicleState vehicle;
    Vector3 omega_ib_b = Vector3::Zero();
  };

  void keepNewest();

  Planet planet_;
  RtsSmoother smoother_;
  std::vector<Epoch> epochs_;  ///< those that the smoother has kept
  Epoch newest_;
  ErrorCovariance newest_P_ = ErrorCovariance::Identity();
  bool is_kept_ = true;  ///< the newest one
};

}  // namespace slipnav
