#include "slipnav/filter/kalman_update.h"

#include <Eigen/Cholesky>
#include <boost/math/distributions/chi_squared.hpp>
#include <stdexcept>

namespace slipnav {
namespace {

/// P Hᵀ, the innovation covariance S and its Cholesky factor.
struct Innovation {
  Innovation(const Measurement& m, const ErrorCovariance& P)
      : PHt(P.lazyProduct(m.H.transpose())), S(m.H.lazyProduct(PHt)) {
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
  InnovationCovariance S;
  Eigen::LLT<InnovationCovariance> cholesky;
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

void addJosephTerms(const KalmanGain& K, const KalmanGain& PHt, const InnovationCovariance& S, ErrorCovariance& P) {
  const KalmanGain half_KS_less_PHt = 0.5 * K.lazyProduct(S) - PHt;
  const ErrorCovariance half = half_KS_less_PHt.lazyProduct(K.transpose());
  P += half + half.transpose();
}

std::optional<ErrorVector> kalmanUpdate(const Measurement& measurement, ErrorCovariance& P) {
  const Innovation innovation(measurement, P);
  if (!innovation.usable) {
    return std::nullopt;
  }
  const KalmanGain K = innovation.gain();
  addJosephTerms(K, innovation.PHt, innovation.S, P);
  return ErrorVector(-K * measurement.residual);
}

double chiSquareQuantile(int degrees, double alpha) {
  if (degrees < 1 || !(alpha > 0.0 && alpha < 1.0)) {
    throw std::invalid_argument("chi-square quantile needs at least one degree of freedom and 0 < alpha < 1");
  }
  return boost::math::quantile(boost::math::complement(boost::math::chi_squared(degrees), alpha));
}

}  // namespace slipnav
