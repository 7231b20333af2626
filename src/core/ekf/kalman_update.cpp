#include "slipnav/core/ekf/kalman_update.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <stdexcept>

namespace slipnav {
namespace {

/// S = H P Hᵀ + R of one measurement, and its Cholesky factor.
struct PredictedRows {
  PredictedRows(const Measurement& m, const ErrorCovariance& P)
      : PHt(covarianceWithPrediction(m.H, P)), S(m.H.lazyProduct(PHt)) {
    S.diagonal() += m.variance;
    usable = m.residual.allFinite() && S.allFinite();
    if (usable) {
      cholesky.compute(S);
      usable = cholesky.info() == Eigen::Success;
    }
  }

  /// K with K L Lᵀ = P Hᵀ: forward, then backward substitution, for all states at once.
  KalmanGain gain() const {
    KalmanGain K = PHt;
    const auto& L = cholesky.matrixLLT();
    const Eigen::Index rows = L.rows();
    for (Eigen::Index r = 0; r < rows; ++r) {
      for (Eigen::Index q = 0; q < r; ++q) {
        K.col(r) -= L(r, q) * K.col(q);
      }
      K.col(r) /= L(r, r);
    }
    for (Eigen::Index r = rows - 1; r >= 0; --r) {
      for (Eigen::Index q = r + 1; q < rows; ++q) {
        K.col(r) -= L(q, r) * K.col(q);
      }
      K.col(r) /= L(r, r);
    }
    K.row(kYawScale).setZero();
    return K;
  }

  KalmanGain PHt;
  InnovationCovariance S;
  Eigen::LLT<InnovationCovariance> cholesky;
  bool usable = false;
};

}  // namespace

Measurement::Measurement(int rows)
    : residual(Vector::Zero(rows)), H(Jacobian::Zero(rows, kErrorStates)), variance(Vector::Zero(rows)) {}

std::optional<double> normalizedInnovationSquared(const Measurement& measurement, const ErrorCovariance& P) {
  const PredictedRows innovation(measurement, P);
  if (!innovation.usable) {
    return std::nullopt;
  }
  const Measurement::Vector weighted = innovation.cholesky.solve(measurement.residual);
  return measurement.residual.dot(weighted);
}

std::optional<InnovationSize> innovationSize(const Measurement& measurement, const ErrorCovariance& P) {
  const PredictedRows innovation(measurement, P);
  if (!innovation.usable) {
    return std::nullopt;
  }
  const Measurement::Vector weighted = innovation.cholesky.solve(measurement.residual);
  return InnovationSize{static_cast<int>(measurement.residual.size()), measurement.residual.dot(weighted),
                        2.0 * innovation.cholesky.matrixLLT().diagonal().array().log().sum()};
}

KalmanGain covarianceWithPrediction(const Measurement::Jacobian& H, const ErrorCovariance& P) {
  KalmanGain PHt(kErrorStates, H.rows());
  for (Eigen::Index row = 0; row < H.rows(); ++row) {
    ErrorVector sum = H(row, 0) * P.col(0);
    for (int k = 1; k < kErrorStates; ++k) {
      sum += H(row, k) * P.col(k);
    }
    PHt.col(row) = sum;
  }
  return PHt;
}

void addJosephTerms(const KalmanGain& K, const KalmanGain& PHt, const InnovationCovariance& S, ErrorCovariance& P) {
  const KalmanGain half = 0.5 * K.lazyProduct(S) - PHt;
  // P + half Kᵀ + K halfᵀ by columns. An entry and its mirror image are sums of the same pairs.
  for (int column = 0; column < kErrorStates; ++column) {
    ErrorVector change = ErrorVector::Zero();
    for (Eigen::Index row = 0; row < K.cols(); ++row) {
      change += K(column, row) * half.col(row) + half(column, row) * K.col(row);
    }
    P.col(column) += change;
  }
}

std::optional<UpdateGain> updateCovariance(const Measurement& measurement, ErrorCovariance& P) {
  const PredictedRows innovation(measurement, P);
  if (!innovation.usable) {
    return std::nullopt;
  }
  const KalmanGain K = innovation.gain();
  addJosephTerms(K, innovation.PHt, innovation.S, P);
  return UpdateGain{K, innovation.cholesky};
}

std::optional<ErrorVector> kalmanUpdate(const Measurement& measurement, ErrorCovariance& P) {
  const std::optional<UpdateGain> used = updateCovariance(measurement, P);
  return used ? std::optional<ErrorVector>(-used->K * measurement.residual) : std::nullopt;
}

void openCovariance(const Measurement& measurement, ErrorCovariance& P) {
  const PredictedRows innovation(measurement, P);
  if (!innovation.usable) {
    return;
  }
  const Measurement::Vector weighted = innovation.cholesky.solve(measurement.residual);
  const double excess = measurement.residual.dot(weighted) / static_cast<double>(measurement.residual.size()) - 1.0;
  if (excess > 0.0) {
    const Eigen::MatrixXd visible = innovation.PHt * innovation.cholesky.solve(innovation.PHt.transpose());
    P += 0.5 * excess * (visible + visible.transpose());
  }
}

double chiSquareQuantile(int degrees, double alpha) {
  if (degrees < 1 || !(alpha > 0.0 && alpha < 1.0)) {
    throw std::invalid_argument("chi-square quantile needs at least one degree of freedom and 0 < alpha < 1");
  }
  return boost::math::quantile(boost::math::complement(boost::math::chi_squared(degrees), alpha));
}

}  // namespace slipnav
