#pragma once
/// How much larger or smaller each kind of noise is than configured, learned from innovations.
///
/// The logarithms θ of the factors on the configured variances are Gaussian, initially N(0, Σ₀), and
/// fade over the distance driven. An innovation r of predicted variance S(θ) = S_rest + Σ Cᵢ exp(θᵢ) has the
/// log-likelihood −½ (ln S + r²/S); its maximum a posteriori along Σg, gᵢ = Cᵢ/S, is the new θ, and ½ggᵀ (Fisher
/// information of a variance) is added to Σ⁻¹. The composition of an innovation decides what it can say: where Cᵢ is
/// small compared with S, θᵢ does not move. Covariance matching after R. K. Mehra, IEEE TAC 17(5), 1972; recursive as
/// in S. Särkkä, A. Nummenmaa, IEEE TAC 54(3), 2009, with a log-normal in place of the inverse gamma, so that noises
/// that share an innovation share its information.

#include "slipnav/core/base/types.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// The noises that are learned.
enum NoiseKind : int {
  kWheelNoise = 0,  ///< white noise of the wheel speed
  kFastSlipNoise,   ///< slip that changes within a meter
  kSlowSlipNoise,   ///< slip that persists
  kLateralNoise,    ///< sway of the body against its path
  kSideSlipNoise,   ///< side slip that persists
  kVerticalNoise,   ///< heave and pitch of the body against its path
  kVibrationNoise,  ///< the fraction of the IMU vibration that integrates like white noise
  kNoiseKinds
};

using NoiseVector = Eigen::Matrix<double, kNoiseKinds, 1>;

/// Block `filter.adaptation`.
struct NoiseScaleParams {
  double length_m = 20.0;
  double factor_std = 3.0;
  double slip_factor_std = 2.0;
  double imu_factor_std = 1.6;
  double whiteness = 1.0;
  double whiteness_factor_std = 3.0;
  void visit(ParameterVisitor& v);
};

/// All factors together.
class NoiseScales {
 public:
  explicit NoiseScales(const NoiseScaleParams& params);

  /// On the configured variance; for kVibrationNoise: the white fraction of the vibration, at most 1.
  double factor(NoiseKind kind) const { return factor_(kind); }

  /// The rover has driven `way_m`: what was learned about the ground behind says less about the ground ahead.
  void fade(double way_m);

  /// @param shares contribution of each noise, at its present factor, to `variance`
  /// @param squared the innovation squared, in the units of `variance`
  void learn(const NoiseVector& shares, double squared, double variance);

 private:
  using Matrix = Eigen::Matrix<double, kNoiseKinds, kNoiseKinds>;

  void refresh();

  double length_m_;
  NoiseVector prior_;  ///< mean of θ before anything is learned
  NoiseVector prior_variance_;
  NoiseVector theta_;
  Matrix sigma_;
  NoiseVector factor_;
};

}  // namespace slipnav
