#include "slipnav/filter/kalman_update.h"

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>
#include <stdexcept>

namespace slipnav {
namespace {

using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxMeasurementRows, kMaxMeasurementRows>;

/// P Hᵀ, the innovation covariance S and its Cholesky factor.
struct Innovation {
  Innovation(const Measurement& m, const ErrorCovariance& P) : PHt(P * m.H.transpose()), S(m.H * PHt) {
    S.diagonal() += m.variance;
    usable = m.residual.allFinite() && S.allFinite();
    if (usable) {
      cholesky.compute(S);
      usable = cholesky.info() == Eigen::Success;
    }
  }

  KalmanGain PHt;

  KalmanGain gain() const {
    KalmanGain K = cholesky.solve(PHt.transpose()).transpose();
    K.row(kYawScale).setZero();
    return K;
  }
  Square S;
  Eigen::LLT<Square> cholesky;
  bool usable = false;
};

}  // namespace

Measurement::Measurement(int rows)
    : residual(Vector::Zero(rows)), H(Jacobian::Zero(rows, kErrorStates)), variance(Vector::Zero(rows)) {}

std::optional<double> normalisedInnovationSquared(const Measurement& measurement, const ErrorCovariance& P) {
  const Innovation innovation(measurement, P);
  if (!innovation.usable) {
    return std::nullopt;
  }
  const Measurement::Vector weighted = innovation.cholesky.solve(measurement.residual);
  return measurement.residual.dot(weighted);
}

std::optional<KalmanGain> kalmanGain(const Measurement& measurement, const ErrorCovariance& P) {
  const Innovation innovation(measurement, P);
  return innovation.usable ? std::optional(innovation.gain()) : std::nullopt;
}

std::optional<ErrorVector> kalmanUpdate(const Measurement& measurement, ErrorCovariance& P) {
  const Innovation innovation(measurement, P);
  if (!innovation.usable) {
    return std::nullopt;
  }
  const KalmanGain& PHt = innovation.PHt;
  const KalmanGain K = innovation.gain();
  // (I−KH) P (I−KH)ᵀ + K R Kᵀ, multiplied out
  const ErrorCovariance cross = K * PHt.transpose();
  const KalmanGain KS = K * innovation.S;
  P += KS * K.transpose() - cross - cross.transpose();
  P = 0.5 * (P + P.transpose()).eval();
  return ErrorVector(-K * measurement.residual);
}

double chiSquareQuantile(int degrees, double alpha) {
  if (degrees < 1 || !(alpha > 0.0 && alpha < 1.0)) {
    throw std::invalid_argument("chi-square quantile needs at least one degree of freedom and 0 < alpha < 1");
  }
  return boost::math::quantile(boost::math::complement(boost::math::chi_squared(degrees), alpha));
}

}  // namespace slipnav
