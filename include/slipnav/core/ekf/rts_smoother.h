#pragma once
/// Runs a Kalman filter's errors backwards: the best estimate of each epoch given all measurements (H. E.
/// Rauch, F. Tung, C. T. Striebel, Maximum likelihood estimates of linear dynamic systems, AIAA Journal 3(8), 1965;
/// Groves 3.4.3; S. Särkkä, Bayesian Filtering and Smoothing, 2013, chapter 8).
///
/// Everything is an error about the filter's own estimate, so that closed loop and resets are part of the chain. From
/// one point of the chain back to the previous one is an affine map, and maps compose: epochs can be kept as rarely as
/// desired, and the result is still exact.

#include <deque>
#include <vector>

#include "slipnav/core/ekf/error_dynamics.h"
#include "slipnav/core/ekf/error_state.h"

namespace slipnav {

/// What all measurements together say about the error of the filter's estimate at one epoch.
struct SmoothedError {
  ErrorVector error = ErrorVector::Zero();          ///< to be removed from the filter's estimate
  ErrorCovariance P = ErrorCovariance::Identity();  ///< of the remaining error, in the filter's own tangent
};

/// Records what the filter does, in order. Allocates one link per kept epoch, 8 kB.
class RtsSmoother {
 public:
  /// Restarts with the covariance of the filter's start.
  void begin(const ErrorCovariance& P);

  /// error ← Φ error + noise. The noise itself is not needed: it shows in the next covariance.
  void propagate(const ErrorCovariance& phi) { transition_ = (phi * transition_).eval(); }
  /// One error has become independent of the past: see forgetError().
  void forget(int index) { transition_.row(index).setZero(); }
  /// The filter's covariance now, before a measurement.
  void advance(const ErrorCovariance& P);
  /// A measurement was used, right after advance(): `error` was removed, and `P` is the filter's covariance since.
  void correct(const ErrorVector& error, const ErrorReset& reset, const ErrorCovariance& P);
  /// As advance(), and this epoch is to be smoothed.
  void keep(const ErrorCovariance& P);

  std::size_t size() const { return links_.size(); }

  /// One for each keep(), in order; the last one is the filter's own.
  std::vector<SmoothedError> smooth() const;

 private:
  /// The error at the beginning as an affine function of that at the end, and the covariance the end does not explain.
  struct Link {
    ErrorCovariance gain = ErrorCovariance::Identity();
    ErrorVector offset = ErrorVector::Zero();
    ErrorCovariance rest = ErrorCovariance::Zero();
  };

  void append(const Link& link);

  ErrorCovariance P_ = ErrorCovariance::Identity();           ///< at the newest point of the chain
  ErrorCovariance transition_ = ErrorCovariance::Identity();  ///< since then
  Link open_;                                                 ///< from the last kept epoch to the newest point
  std::deque<Link> links_;                                    ///< each from one kept epoch to the next
};

}  // namespace slipnav
