#include "slipnav/core/ekf/engine/unexpected_slip.h"

#include <Eigen/Cholesky>

namespace slipnav {
namespace {

constexpr double kShortestWay_m = 1.0;

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

/// In powers of the distance relative to the whole way, so that each coefficient is the slip that it contributes.
std::optional<UnexpectedSlip::Finding> UnexpectedSlip::finding() const {
  if (way_m_ < kShortestWay_m) {
    return std::nullopt;
  }
  const Eigen::Matrix<double, kTerms, kTerms> scale = powersOf(1.0 / way_m_).asDiagonal();
  Eigen::Matrix<double, kTerms, kTerms> precision = scale * information_ * scale;
  precision.diagonal().array() += 1.0;
  const Eigen::Matrix<double, kTerms, kTerms> covariance =
      precision.llt().solve(Eigen::Matrix<double, kTerms, kTerms>::Identity());
  const Terms weighted = scale * weighted_;
  const Terms slip = covariance * weighted;
  const Eigen::Matrix<double, kErrorStates, kTerms> from_slip = from_slip_ * scale;
  Finding finding;
  finding.squared = weighted.dot(slip);
  finding.error = from_slip * slip;
  const ErrorCovariance P = from_slip * covariance * from_slip.transpose();
  finding.P = 0.5 * (P + P.transpose());
  return finding;
}

}  // namespace slipnav
