#pragma once
/// What the filter learns about noise while driving: which innovation informs which noise, and the resulting Q and R.

#include "slipnav/core/ekf/adaptation/imu_doubt.h"
#include "slipnav/core/ekf/adaptation/imu_noise_meter.h"
#include "slipnav/core/ekf/adaptation/noise_scales.h"
#include "slipnav/core/ekf/error_dynamics.h"
#include "slipnav/core/ekf/models/wheel_odometry.h"
#include "slipnav/core/ins/ins_engine.h"

namespace slipnav {

/// Of one row, before the update.
struct Innovation1 {
  double residual = 0.0;            ///< r
  double variance = 0.0;            ///< S
  double by_persistent_slip = 0.0;  ///< the part of S explained by the slow or side slip, see explainedBy()
};

/// The part of the variance of H δx explained by the error of one state: (H P e)²/P(e, e). When a slipping rover
/// stops, this is how a wrong persistent slip shows up: as velocity.
double explainedBy(int state, const Measurement::Jacobian& H, const ErrorCovariance& P);

/// Holds the factors on configured noise, the IMU vibration, and what has been added to P since a measurement.
class NoiseAdaptation {
 public:
  NoiseAdaptation(const NoiseScaleParams& params, const ImuNoiseParams& imu, double slope_slip);

  void reset();
  /// Samples of the IMU are missing.
  void interrupt() { meter_.interrupt(); }

  /// Adds slip of the ground under a step, its noise and that of IMU vibration to a transition.
  /// @param state at the end of the step; @param slow_slip learned in this drive, 0 for none; @param way_m of the
  /// wheels' surface in it
  void addNoise(const ErrorDynamics& dynamics, const InsStep& step, const NavigationState& state, double slow_slip,
                double way_m, ErrorTransition& transition);

  /// Steady-state slip of the ground, as of the last step.
  const GroundStep& ground() const { return ground_; }
  NoiseFactors factors() const;
  /// Noise density of the gyros including vibration, mean over the axes [rad²/s].
  double gyroDensity() const;

  /// Variance of the accelerometer bias in motion about that at rest [(m/s²)²].
  double biasShiftVariance() const;

  /// A forward speed has been compared with its prediction.
  void learnForward(const WheelOdometryParams& params, const WheelInterval& wheels, const Innovation1& innovation);
  /// A mean lateral or vertical speed has been compared with its prediction.
  /// @param own_variance R of the measurement; @param aside_n the vehicle's y axis, unit, north-east-down
  void learnLateral(double own_variance, const Innovation1& innovation, const Vector3& aside_n);
  void learnVertical(double own_variance, const Innovation1& innovation);
  void constraintsUsed();

 private:
  /// Variance added to states since the last measurement.
  struct Since {
    double fast_slip = 0.0;
    Vector3 vibration_b = Vector3::Zero();  ///< of the velocity [m²/s²]
  };
  static void add(const ErrorTransition& transition, const Vector3& vibration_b, Since& since);
  void addDoubt(const ImuNoiseDensity& shaking, const Matrix3& squared, double duration_s,
                ErrorTransition& transition) const;
  void learnConstraint(NoiseKind kind, double own_variance, const Innovation1& innovation, double squared,
                       NoiseVector shares);

  NoiseScaleParams params_;
  ImuFloor floor_;
  double slope_slip_;
  NoiseScales scales_;
  ImuNoiseMeter meter_;
  ImuDoubt doubt_;
  SuccessiveDifference sideways_;
  SuccessiveDifference off_ground_;
  GroundStep ground_;
  Since forward_;
  Since constraints_;
  double way_m_ = 0.0;  ///< since the factors last faded
};

}  // namespace slipnav
