#pragma once
/// How the position error has grown since the last stop, and how it will grow while the rover drives on.
///
/// The filter's own variance is not the answer. Its gains are made for slip as its parameters describe it, for any
/// ground that the rover may meet; the slip of this ground is another. So a second covariance goes along, that of the
/// error which the filter really makes with its gains when the slip is as learned (Maybeck 1979, section 6.8; Gelb
/// 1974, section 7.2: analysis of suboptimal filters). Slip that persists is a state of it, not white noise: white slip
/// of 5 % adds 0.10 m over 48 m, constant slip 2.4 m.
///
/// The paper propagates with Φ and H of the present state (section IV-D). Yet it is the rocking of the rover that lets
/// the filter tell speed from slip, so the way ahead is taken to be like the way behind: its attitudes, played back.

#include <Eigen/Core>
#include <vector>

#include <optional>

#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/engine/filter_params.h"

namespace slipnav {

/// What is known of the ground, and expected of it over the horizon.
struct GroundOutlook {
  double speed_mps = 0.0;               ///< forward, over ground
  double wheel_speed_mps = 0.0;         ///< circumferential, at the slip expected
  double wheel_noise_variance = 0.0;    ///< of one wheel speed sample, uncorrelated [m²/s²]
  double wheel_share = 1.0;             ///< of the wheel speeds that the filter uses: slip impulses are left out
  double drift_std = 0.0;               ///< of the slip ratio that persists, 1σ
  double change_std = 0.0;              ///< of the slip ratio that comes and goes, 1σ
  std::optional<double> change_time_s;  ///< its time constant; none: the filter's own length
  double side_slip_std_rad = 0.0;       ///< 1σ
};

/// One step of driving, as it was or as it is expected.
struct DriveStep {
  NavigationState state;                     ///< at its end; position, attitude and velocity are used
  Vector3 acceleration_n = Vector3::Zero();  ///< mean, over ground [m/s²]
  double speed_mps = 0.0;                    ///< forward, over ground
  double wheel_speed_mps = 0.0;              ///< circumferential
  double wheel_share = 1.0;                  ///< of the wheel speeds that the filter used or will use
  NoiseFactors noise_factors;                ///< by which the filter scales its variances
};

/// Carries the filter's covariance and that of the real error side by side, along the way driven and the way ahead.
class CovarianceForecast {
 public:
  /// @param step_s of all steps; @param wheel_interval_s between the wheel samples that are averaged over a step
  /// Throws std::invalid_argument unless both are above zero.
  CovarianceForecast(const Planet& planet, const FilterSetup& setup, double step_s, double wheel_interval_s);

  /// The filter takes its measurements for better or worse from now on.
  void retune(const FilterSetup& setup) { setup_ = setup; }

  /// The filter's slip model as an outlook, with what it has learned of wheels and ground.
  GroundOutlook assumption(const NoiseFactors& factors = {}) const;

  /// The rover stands, or the estimate begins: the error is what the filter says.
  /// @param growth the position error counts from here
  void restart(const ErrorCovariance& P, bool growth);

  /// The rover has driven a step.
  /// @param P the filter's covariance after it, from which the gains of the next step follow
  void follow(const DriveStep& step, const ErrorCovariance& P, const GroundOutlook& outlook);

  /// Root of the sum of the north and east variances after each step to come [m].
  std::vector<double> ahead(const std::vector<DriveStep>& steps, const GroundOutlook& outlook) const;

  /// Covariance of the errors really made.
  const ErrorCovariance& reality() const { return reality_; }

  /// Of the forward velocity, as the filter claims it [m²/s²].
  double forwardVariance(const NavigationState& state) const;

 private:
  struct Odometry {
    Measurement::Jacobian H;
    Measurement::Vector claimed;  ///< variances that the filter takes
    Measurement::Vector real;     ///< variances that there are
  };

  Odometry odometry(const DriveStep& step, const GroundOutlook& outlook) const;
  ErrorTransition transition(const DriveStep& step) const;
  /// What differs between the filter's model of the ground and the outlook: how vehicle states decay and are driven.
  ErrorTransition onGround(ErrorTransition transition, const DriveStep& step, const GroundOutlook& outlook) const;

  /// Where the filter has doubted its slip or its speed, the error really made is as uncertain.
  void openAsTheFilter(const NavigationState& state, const ErrorCovariance& P);

  /// Both covariances through one step.
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
