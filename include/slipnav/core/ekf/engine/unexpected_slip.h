#pragma once
/// Slip on the way from one stop to the next that the filter did not consider possible.
///
/// Where the ground changes over tens of meters, the wheels pull the velocity along: what slip grows by in a second is
/// less than what a tilt does. A stop, or many small contradictions, show it long after the position was lost. Here the
/// slip of the whole way is a polynomial of the distance with coefficients θ that the filter does not have. Beside
/// the filter runs what each of them has done to its errors,
///
///     V ← Φ V + what the slip grows by,   U = H V,   V ← V − K U,
///     Λ ← Λ + Uᵀ S⁻¹ U,   ξ ← ξ − Uᵀ S⁻¹ r,
///
/// so that θ = Λ⁻¹ ξ is what all innovations r together say of them, and V θ the error that it left in each state: the
/// two-stage filter (B. Friedland, Treatment of bias in recursive filtering, IEEE TAC 14, 1969). It is exact where the
/// filter is linear.

#include "slipnav/core/ekf/error_dynamics.h"
#include "slipnav/core/ekf/kalman_update.h"

namespace slipnav {

/// What the way since the last standstill says of its slip.
class UnexpectedSlip {
 public:
  /// The slip of a way is constant, linear and square in the distance since its begin.
  static constexpr int kTerms = 3;

  /// In the errors of the filter.
  struct Finding {
    double slip = 0.0;  ///< at the end of the way, of the wheels beyond what the filter expected of the ground
    ErrorVector error = ErrorVector::Zero();      ///< estimate − truth
    ErrorCovariance P = ErrorCovariance::Zero();  ///< to be added: θ is not known exactly
  };

  /// @param shortest_way_m what happens within less is not said
  explicit UnexpectedSlip(double shortest_way_m) : shortest_way_m_(shortest_way_m) { begin(); }

  /// The way begins here.
  void begin();
  /// @param way_m of the wheels' surface in this step
  void propagate(const ErrorTransition& transition, double way_m);
  /// The filter has forgotten this state.
  void forget(int state) { from_slip_.row(state).setZero(); }
  /// @param used what the filter has done with `measurement`; @param is_evidence false for what nobody has measured
  void update(const Measurement& measurement, const UpdateGain& used, bool is_evidence);

  /// θᵀ (Λ + 1/prior) θ of the way so far: chi-square with kTerms degrees of freedom if there is no such slip; 0 before
  /// the shortest way. A priori each term is as much as wheels on ice: 1.
  double squared() const;
  /// Once that is more than 0.
  Finding finding() const;

 private:
  using Terms = Eigen::Matrix<double, kTerms, 1>;
  using TermMatrix = Eigen::Matrix<double, kTerms, kTerms>;

  /// In powers of the distance relative to the whole way, so that each coefficient is the slip that it contributes.
  struct Posterior {
    Terms weighted;         ///< ξ
    TermMatrix covariance;  ///< (Λ + 1/prior)⁻¹
  };
  Posterior posterior() const;

  Eigen::Matrix<double, kErrorStates, kTerms> from_slip_;  ///< V, per power of the distance in meters
  TermMatrix information_;                                 ///< Λ
  Terms weighted_;                                         ///< ξ
  double way_m_ = 0.0;
  double shortest_way_m_;
};

}  // namespace slipnav
