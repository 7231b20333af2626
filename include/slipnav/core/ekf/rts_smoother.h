#pragma once
/// Runs a Kalman filter's errors backwards: what each epoch is known to have been once all measurements are in (H. E.
/// Rauch, F. Tung, C. T. Striebel, Maximum likelihood estimates of linear dynamic systems, AIAA Journal 3(8), 1965;
/// Groves 3.4.3; S. Särkkä, Bayesian Filtering and Smoothing, 2013, chapter 8).
///
/// Everything is an error about the filter's own estimate, so that closed loop and resets are part of the chain. From
/// one point of the chain to the next the way back is an affine map, and maps compose: epochs are kept as seldom as one
/// likes, and what lies between them is exact.

#include <deque>
#include <vector>

#include "slipnav/core/ekf/error_dynamics.h"
#include "slipnav/core/ekf/error_state.h"

namespace slipnav {

/// What all measurements together say of the error that the filter's estimate had at one epoch.
struct SmoothedError {
  ErrorVector error = ErrorVector::Zero();          ///< to be taken out of the filter's estimate
  ErrorCovariance P = ErrorCovariance::Identity();  ///< of what is left, in the filter's own tangent
};

/// Told what the filter does, in order. Allocates one link per kept epoch, 8 kB.
class RtsSmoother {
 public:
  /// Begins anew with the covariance of the filter's start.
  void begin(const ErrorCovariance& P);

  /// error ← Φ error + noise. The noise need not be told: it shows in the next covariance.
  void propagate(const ErrorCovariance& phi) { transition_ = (phi * transition_).eval(); }
  /// One error has become independent of all that was: see forgetError().
  void forget(int index) { transition_.row(index).setZero(); }
  /// The filter's covariance now, before a measurement.
  void advance(const ErrorCovariance& P);
  /// A measurement was used, right after advance(): `error` was taken out, and `P` is what the filter has since.
  void correct(const ErrorVector& error, const ErrorReset& reset, const ErrorCovariance& P);
  /// As advance(), and this epoch is one to be smoothed.
  void keep(const ErrorCovariance& P);

  std::size_t size() const { return links_.size(); }

  /// One for each keep(), in their order; the last one is the filter's own.
  std::vector<SmoothedError> smooth() const;

 private:
  /// The error at the beginning as an affine function of that at the end, and what the end cannot tell of it.
  struct Link {
    ErrorCovariance gain = ErrorCovariance::Identity();
    ErrorVector offset = ErrorVector::Zero();
    ErrorCovariance rest = ErrorCovariance::Zero();
  };

  void append(const Link& link);

  ErrorCovariance P_ = ErrorCovariance::Identity();           ///< at the newest point of the chain
  ErrorCovariance transition_ = ErrorCovariance::Identity();  ///< since then
  Link open_;                                                 ///< from the epoch kept last to the newest point
  std::deque<Link> links_;                                    ///< each from the epoch before to the one kept
};

}  // namespace slipnav
