#pragma once
/// One measurement update for every model: Joseph form with consider states (Groves 3.2.5; Schmidt 1966).

#include <Eigen/Cholesky>
#include <optional>

#include "slipnav/core/ekf/error_state.h"

namespace slipnav {

inline constexpr int kMaxMeasurementRows = 6;

/// A linearized measurement. The prediction comes from the estimate, and error = estimate − truth, hence
/// residual = measured − predicted = −H · error + noise.
struct Measurement {
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxMeasurementRows, 1>;
  using Jacobian =
      Eigen::Matrix<double, Eigen::Dynamic, kErrorStates, Eigen::RowMajor, kMaxMeasurementRows, kErrorStates>;

  /// @param rows 1 … kMaxMeasurementRows; all entries zero
  explicit Measurement(int rows);

  Vector residual;  ///< measured − predicted
  Jacobian H;       ///< ∂(predicted)/∂(state)
  Vector variance;  ///< of the measurement noise, which is uncorrelated between rows
};

/// rᵀ (H P Hᵀ + R)⁻¹ r, chi-square distributed with as many degrees of freedom as rows when the filter is consistent.
/// Nothing if the residual is not finite or the innovation covariance not positive definite.
std::optional<double> normalizedInnovationSquared(const Measurement& measurement, const ErrorCovariance& P);

/// An innovation r relative to its own covariance S = H P Hᵀ + R.
struct InnovationSize {
  int rows = 0;
  double squared = 0.0;          ///< rᵀ S⁻¹ r
  double log_determinant = 0.0;  ///< ln |S|, in the units of the measurement squared
};

/// Nothing where normalizedInnovationSquared() returns nothing.
std::optional<InnovationSize> innovationSize(const Measurement& measurement, const ErrorCovariance& P);

using KalmanGain = Eigen::Matrix<double, kErrorStates, Eigen::Dynamic, 0, kErrorStates, kMaxMeasurementRows>;

/// H P Hᵀ + R of one measurement.
using InnovationCovariance =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxMeasurementRows, kMaxMeasurementRows>;

/// What an update has used: the gain K = P Hᵀ S⁻¹, and S by its Cholesky factor.
struct UpdateGain {
  KalmanGain K;
  Eigen::LLT<InnovationCovariance> S;
};

/// Updates P and returns the gain P Hᵀ (H P Hᵀ + R)⁻¹ that was used. Nothing, and P unchanged, if the residual is not
/// finite or the innovation covariance not positive definite.
///
/// The gain of the consider state kYawScale is zero; the Joseph form holds for any gain.
std::optional<UpdateGain> updateCovariance(const Measurement& measurement, ErrorCovariance& P);

/// As updateCovariance(), but returns the estimated error, to be removed from the state.
std::optional<ErrorVector> kalmanUpdate(const Measurement& measurement, ErrorCovariance& P);

/// Inflates P along its own correlations until `measurement`, which has contradicted for long, has a plausible
/// normalized innovation squared: P ← P + (α−1) P Hᵀ S⁻¹ H P with α = rᵀS⁻¹r / n. A contradiction that lasts
/// means the state is wrong. Does nothing if the innovation is already plausible.
void openCovariance(const Measurement& measurement, ErrorCovariance& P);

/// P Hᵀ: covariance of the state's errors with those of the measurement's prediction.
KalmanGain covarianceWithPrediction(const Measurement::Jacobian& H, const ErrorCovariance& P);

/// P ← (I − K H) P (I − K H)ᵀ + K R Kᵀ for any gain, multiplied out; P stays symmetric to the last bit.
/// @param PHt P Hᵀ; @param S H P Hᵀ + R
void addJosephTerms(const KalmanGain& K, const KalmanGain& PHt, const InnovationCovariance& S, ErrorCovariance& P);

/// 1 − alpha quantile of the chi-square distribution with `degrees` degrees of freedom.
/// Throws std::invalid_argument unless degrees ≥ 1 and 0 < alpha < 1.
double chiSquareQuantile(int degrees, double alpha);

}  // namespace slipnav
