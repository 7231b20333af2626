#pragma once
/// Record of what the filter did in a drive, so that its errors can be run backwards afterwards (RtsSmoother).

#include <vector>

#include "slipnav/core/ekf/error_dynamics.h"
#include "slipnav/core/ekf/error_state.h"
#include "slipnav/core/ekf/rts_smoother.h"

namespace slipnav {

/// The state at an epoch given all measurements of the drive.
struct SmoothedState {
  NavigationState nav;
  VehicleState vehicle;
  Vector3 omega_ib_b = Vector3::Zero();  ///< mean rate of the step that ends here, less the smoothed bias [rad/s]
  ErrorCovariance P = ErrorCovariance::Identity();  ///< about this state
};

/// A FilterEngine reports each of its steps, see FilterEngine::keepHistory(). Ten epochs a second are kept, at 8 kB
/// each: 75 MB for a quarter of an hour, whatever the sensor rates, and as much again in smooth().
class FilterHistory {
 public:
  explicit FilterHistory(const Planet& planet) : planet_(planet) {}

  /// The filter has started or restarted: earlier epochs are dropped.
  void begin(const ErrorCovariance& P);

  void propagate(const ErrorTransition& transition) { smoother_.propagate(transition.matrix()); }
  void forget(int index) { smoother_.forget(index); }
  void advance(const ErrorCovariance& P) { smoother_.advance(P); }
  void correct(const ErrorVector& error, const ErrorReset& reset, const ErrorCovariance& P) {
    smoother_.correct(error, reset, P);
  }
  /// A step has ended, with this as the filter's estimate at its end.
  void endStep(const NavigationState& nav, const VehicleState& vehicle, const Vector3& omega_ib_b,
               const ErrorCovariance& P);

  /// The kept epochs, in order; the last one is the filter's own estimate after its last step. Empty before
  /// the first step.
  std::vector<SmoothedState> smooth();

 private:
  /// The filter's estimate at the end of a step.
  struct Epoch {
    NavigationState nav;
    VehicleState vehicle;
    Vector3 omega_ib_b = Vector3::Zero();
  };

  void keepNewest();

  Planet planet_;
  RtsSmoother smoother_;
  std::vector<Epoch> epochs_;  ///< those the smoother has kept
  Epoch newest_;
  ErrorCovariance newest_P_ = ErrorCovariance::Identity();
  bool is_kept_ = true;  ///< the newest one
};

}  // namespace slipnav
