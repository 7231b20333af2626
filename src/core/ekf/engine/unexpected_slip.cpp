#include "slipnav/core/ekf/engine/unexpected_slip.h"

#include <Eigen/Cholesky>

namespace slipnav {
namespace {

using Terms = Eigen::Matrix<double, UnexpectedSlip::kTerms, 1>;

/// 1, w, w², …
Terms powersOf(double way_m) {
  Terms powers = Terms::Ones();
  for (int k = 1; k < UnexpectedSlip::kTerms; ++k) {
    powers(k) = way_m * powers(k - 1);
  }
  return powers;
}

}  // namespace

void UnexpectedSlip::begin() {
  from_slip_.setZero();
  from_slip_(kSlowSlip, 0) = 1.0;
  information_.setZero();
  weighted_.setZero();
  way_m_ = 0.0;
}

void UnexpectedSlip::propagate(const ErrorTransition& transition, double way_m) {
  const Terms before = powersOf(way_m_);
  way_m_ += way_m;
  const double decay = transition.decay(kSlowSlip - 9);
  from_slip_ = transition.times(from_slip_);
  from_slip_.row(kSlowSlip) += (powersOf(way_m_) - decay * before).transpose();
}

void UnexpectedSlip::update(const Measurement& measurement, const UpdateGain& used, bool is_evidence) {
  const Eigen::Matrix<double, Eigen::Dynamic, kTerms, 0, kMaxMeasurementRows, kTerms> seen =
      measurement.H.lazyProduct(from_slip_);
  if (is_evidence) {
    information_ += seen.transpose().lazyProduct(used.S.solve(seen));
    weighted_ -= seen.transpose().lazyProduct(used.S.solve(measurement.residual));
  }
  from_slip_ -= used.K.lazyProduct(seen);
}

UnexpectedSlip::Posterior UnexpectedSlip::posterior() const {
  const TermMatrix scale = powersOf(1.0 / way_m_).asDiagonal();
  TermMatrix precision = scale * information_ * scale;
  precision.diagonal().array() += 1.0;
  return {scale * weighted_, precision.llt().solve(TermMatrix::Identity())};
}

double UnexpectedSlip::squared() const {
  if (way_m_ < shortest_way_m_) {
    return 0.0;
  }
  const Posterior slip = posterior();
  return slip.weighted.dot(slip.covariance * slip.weighted);
}

UnexpectedSlip::Finding UnexpectedSlip::finding() const {
  const Posterior slip = posterior();
  const Eigen::Matrix<double, kErrorStates, kTerms> from_slip = from_slip_ * powersOf(1.0 / way_m_).asDiagonal();
  const ErrorCovariance P = from_slip * slip.covariance * from_slip.transpose();
  const Terms theta = slip.covariance * slip.weighted;
  return {-theta.sum(), from_slip * theta, 0.5 * (P + P.transpose())};
}

}  // namespace slipnav
