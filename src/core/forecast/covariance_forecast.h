#pragma once
/// How the position error has grown since the last stop, and how it will grow while the rover keeps driving.
///
/// The filter's own variance is not the answer. Its gains are designed for slip as its parameters describe it, for any
/// ground that the rover may meet; the slip of this ground differs. So a second covariance is propagated, that of the
/// actual error of the filter with its gains if the slip is as learned (Maybeck 1979, section 6.8; Gelb 1974, section
/// 7.2: analysis of suboptimal filters). Persistent slip is a state in it, not white noise: white slip of 5 % adds
/// 0.10 m over 48 m, constant slip 2.4 m.
///
/// The paper propagates with Φ and H of the present state (section IV-D). However, it is the rocking of the rover that
/// lets the filter distinguish speed from slip, so the path ahead is assumed to resemble the path behind: its attitudes
/// are played back.

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/engine/filter_params.h"

namespace slipnav {

/// What is known about the ground, and expected of it over the horizon.
struct GroundOutlook {
  double speed_mps = 0.0;               ///< forward, over ground
  double wheel_speed_mps = 0.0;         ///< circumferential, at the expected slip
  double wheel_noise_variance = 0.0;    ///< of one wheel speed sample, uncorrelated [m²/s²]
  double wheel_share = 1.0;             ///< of the wheel speeds that the filter uses: slip impulses are excluded
  double drift_std = 0.0;               ///< of the persistent slip ratio, 1σ
  double change_std = 0.0;              ///< of the varying slip ratio, 1σ
  std::optional<double> change_time_s;  ///< its time constant; if empty, the filter's own length applies
  double side_slip_std_rad = 0.0;       ///< 1σ
};

/// One step of driving, past or expected.
struct DriveStep {
  NavigationState state;                     ///< at its end; position, attitude and velocity are used
  Vector3 acceleration_n = Vector3::Zero();  ///< mean, over ground [m/s²]
  double speed_mps = 0.0;                    ///< forward, over ground
  double wheel_speed_mps = 0.0;              ///< circumferential
  double wheel_share = 1.0;                  ///< of the wheel speeds that the filter used or will use
  NoiseFactors noise_factors;                ///< by which the filter scales its variances
};

/// Propagates the filter's covariance and that of the actual error side by side, along the path driven and the path
/// ahead.
class CovarianceForecast {
 public:
  /// @param step_s of all steps; @param wheel_interval_s between the wheel samples that are averaged over a step
  /// Throws std::invalid_argument unless both are above zero.
  CovarianceForecast(const Planet& planet, const FilterSetup& setup, double step_s, double wheel_interval_s);

  /// The filter trusts its measurements more or less from now on.
  void retune(const FilterSetup& setup) { setup_ = setup; }

  /// The filter's slip model as an outlook, with what it has learned about wheels and ground.
  GroundOutlook assumption(const NoiseFactors& factors = {}) const;

  /// The rover stands still, or the estimate begins: the error is what the filter claims.
  /// @param growth whether the position error counts from here
  void restart(const ErrorCovariance& P, bool growth);

  /// The rover has driven a step.
  /// @param P the filter's covariance after it, from which the gains of the next step follow
  void follow(const DriveStep& step, const ErrorCovariance& P, const GroundOutlook& outlook);

  /// The persistent slip is in error by at least this variance.
  void persist(double slip_variance) {
    reality_(kSlowSlip, kSlowSlip) = std::max(reality_(kSlowSlip, kSlowSlip), slip_variance);
  }

  /// Root of the sum of the north and east variances after each future step [m].
  std::vector<double> ahead(const std::vector<DriveStep>& steps, const GroundOutlook& outlook) const;

  /// Covariance of the actual errors.
  const ErrorCovariance& reality() const { return reality_; }

  /// Variance of the forward velocity as claimed by the filter [m²/s²].
  double forwardVariance(const NavigationState& state) const;

 private:
  struct Odometry {
    Measurement::Jacobian H;
    Measurement::Vector claimed;  ///< variances that the filter assumes
    Measurement::Vector real;     ///< actual variances
  };

  Odometry odometry(const DriveStep& step, const GroundOutlook& outlook) const;
  ErrorTransition transition(const DriveStep& step) const;
  /// Where the filter's ground model and the outlook differ: how vehicle states decay and are driven.
  ErrorTransition onGround(ErrorTransition transition, const DriveStep& step, const GroundOutlook& outlook) const;

  /// Where the filter has inflated its slip or its speed, the actual error is just as uncertain.
  void openAsTheFilter(const NavigationState& state, const ErrorCovariance& P);

  /// Propagates both covariances through one step.
  void advance(const DriveStep& step, const GroundOutlook& outlook, ErrorCovariance& claim,
               ErrorCovariance& reality) const;

  Planet planet_;
  FilterSetup setup_;
  ErrorDynamics dynamics_;
  double step_s_;
  double samples_per_step_;
  ErrorCovariance claim_ = ErrorCovariance::Zero();
  ErrorCovariance reality_ = ErrorCovariance::Zero();
};

}  // namespace slipnav
