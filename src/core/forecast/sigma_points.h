#pragma once
/// Wheel speed from predicted slip: mean and variance through the slip ratio by sigma points.
///
/// With v the speed of the vehicle over ground and s the slip ratio, the wheel's circumference moves at
///   rω = v/(1 − s)  for s ≥ 0 (driving, s = 1 − v/(rω)),
///   rω = v (1 + s)  for s < 0 (braking, s = rω/v − 1).
///
/// Sources: Kilic et al. 2021, section IV-C; S. Julier, J. Uhlmann, A new method for the nonlinear transformation of
/// means and covariances in filters and estimators, IEEE Transactions on Automatic Control 45(3), 2000.

#include <array>
#include <string>

#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Which equations apply.
enum class SigmaPointForm {
  /// Points μ, μ ± cσ with weights 1 − 1/c², 1/(2c²), 1/(2c²): exact on a linear map; variance in (m/s)².
  kUnscented,
  /// The paper's points v/(1 − μ) and v/(1 − μ ± σ), equal weights, variance their mean squared spread: its equations
  /// with σ_s a standard deviation and R^GP the mean squared spread that the paper calls σ_χ. In (m/s)².
  kPaper,
  /// The paper's equations literally: σ_s is the variance of slip, as the paper says, and the mean squared spread is
  /// squared once more: (m/s)⁴, and millions of times too small. For comparison only.
  kLetter,
};

/// Block `forecast.sigma_points`.
struct SigmaPointParameters {
  std::string form = "unscented";      ///< unscented, paper or letter
  double spread = 1.7320508075688772;  ///< c, at least 1; √3 matches the fourth moment of a Gaussian
  double max_slip = 0.9;               ///< points are clamped to ±max_slip, short of the pole at s = 1

  void visit(ParameterVisitor& v);
};

/// rω for one slip ratio in [−1, 1) [m/s].
double wheelSpeedFromSlip(double speed_mps, double slip);

/// Circumferential speed of the wheels at the predicted slip.
struct WheelSpeedPrediction {
  double mean_mps = 0.0;
  double variance = 0.0;  ///< (m/s)² except for kLetter
  /// Change of wheel speed per unit of slip, from the statistical linearization Cov(χ, s)/Var(s) [m/s]; it couples a
  /// persistent slip error to the wheel speed.
  double sensitivity_mps = 0.0;
};

/// Maps mean and deviation of slip through the relation above. Immutable.
class SigmaPoints {
 public:
  /// Throws std::invalid_argument naming a parameter that is out of range.
  explicit SigmaPoints(const SigmaPointParameters& parameters);

  /// @param speed_mps over ground
  /// @param slip_mean,slip_stddev of the predicted slip; the deviation is not negative
  WheelSpeedPrediction predict(double speed_mps, double slip_mean, double slip_stddev) const;

  /// Wheel speeds at the points, that of the mean first [m/s].
  std::array<double, 3> points(double speed_mps, double slip_mean, double slip_stddev) const;

 private:
  WheelSpeedPrediction unscented(double speed_mps, double slip_mean, double slip_stddev) const;
  WheelSpeedPrediction paper(double speed_mps, double slip_mean, double slip_stddev) const;
  double wheelSpeed(double speed_mps, double slip) const;
  double reach(double slip_stddev) const;
  double clampSlip(double slip) const;

  SigmaPointForm form_;
  double spread_;
  double max_slip_;
};

}  // namespace slipnav
