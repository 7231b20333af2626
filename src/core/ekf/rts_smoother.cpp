#include "slipnav/core/ekf/rts_smoother.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace slipnav {
namespace {

/// Added to correlations before inversion: anything smaller is rounding.
constexpr double kLeastEigenvalue = 1e-13;

/// P Φᵀ P_next⁻¹, with each error in units of its own standard deviation. One without variance has nothing to pass on.
ErrorCovariance gainOf(const ErrorCovariance& P, const ErrorCovariance& transition, const ErrorCovariance& P_next) {
  const ErrorVector weight =
      P_next.diagonal().unaryExpr([](double variance) { return variance > 0.0 ? 1.0 / std::sqrt(variance) : 0.0; });
  ErrorCovariance correlation = weight.asDiagonal() * P_next * weight.asDiagonal();
  correlation.diagonal().array() += kLeastEigenvalue;
  const ErrorCovariance cross = weight.asDiagonal() * (transition * P);
  return (weight.asDiagonal() * correlation.ldlt().solve(cross)).transpose();
}

/// Symmetric to the last bit.
ErrorCovariance congruence(const ErrorCovariance& A, const ErrorCovariance& P) {
  const ErrorCovariance product = A * P * A.transpose();
  return 0.5 * (product + product.transpose());
}

}  // namespace

void RtsSmoother::begin(const ErrorCovariance& P) {
  P_ = P;
  transition_.setIdentity();
  open_ = Link{};
  links_.clear();
}

void RtsSmoother::append(const Link& link) {
  open_.offset += open_.gain * link.offset;
  open_.rest += congruence(open_.gain, link.rest);
  open_.gain = (open_.gain * link.gain).eval();
}

/// The remainder in the form that holds for any gain, and is never negative.
void RtsSmoother::advance(const ErrorCovariance& P) {
  if (P == P_ && transition_.isIdentity(0.0)) {
    return;
  }
  Link link;
  link.gain = gainOf(P_, transition_, P);
  const ErrorCovariance unexplained = ErrorCovariance::Identity() - link.gain * transition_;
  const ErrorCovariance noise = P - congruence(transition_, P_);
  link.rest = congruence(unexplained, P_) + congruence(link.gain, noise);
  append(link);
  P_ = P;
  transition_.setIdentity();
}

/// With e the error before and e' that about the corrected state: e' = R (e − error), hence e = error + R⁻¹ e'.
void RtsSmoother::correct(const ErrorVector& error, const ErrorReset& reset, const ErrorCovariance& P) {
  Link link;
  link.offset = error;
  link.gain.topLeftCorner<9, 9>() = reset.nav.inverse();
  link.gain.block<3, 3>(kAccelBias, kAccelBias) = reset.accel_bias.transpose();
  append(link);
  P_ = P;
}

void RtsSmoother::keep(const ErrorCovariance& P) {
  advance(P);
  links_.push_back(open_);
  open_ = Link{};
}

std::vector<SmoothedError> RtsSmoother::smooth() const {
  std::vector<SmoothedError> epochs(links_.size());
  SmoothedError later{ErrorVector::Zero(), P_};
  for (std::size_t i = links_.size(); i-- > 0;) {
    epochs[i] = later;
    const Link& link = links_[i];
    later.error = link.offset + link.gain * later.error;
    later.P = link.rest + congruence(link.gain, later.P);
  }
  return epochs;
}

}  // namespace slipnav
