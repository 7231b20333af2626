#include "slipnav/core/ekf/engine/gated_update.h"

#include <limits>

namespace slipnav {

GatedUpdate::GatedUpdate(const FilterParams& params)
    : max_rejection_s_(0.0), max_standstill_doubt_s_(0.0), gate_{}, zero_gate_{} {
  retune(params);
}

void GatedUpdate::retune(const FilterParams& params) {
  max_rejection_s_ = params.max_rejection_s;
  max_standstill_doubt_s_ = params.max_standstill_doubt_s;
  for (int rows = 1; rows <= kMaxMeasurementRows; ++rows) {
    gate_[static_cast<std::size_t>(rows)] = chiSquareQuantile(rows, params.gate_alpha);
    zero_gate_[static_cast<std::size_t>(rows)] = chiSquareQuantile(rows, params.zero_velocity_gate_alpha);
  }
}

double GatedUpdate::limit(const MeasurementSet::Block& block) const {
  const bool zero = block.component == kZeroVelocity || block.component == kZeroRate;
  const auto rows = static_cast<int>(block.measurement.residual.size());
  return zero ? zeroGate(rows) : gate(rows);
}

/// How long a measurement may contradict before the state is doubted instead. Scrub and slip of one side contradict the
/// gyro for long, and a receiver may be wrong for long: neither justifies inflating the covariance.
double GatedUpdate::patience(Component component) const {
  switch (component) {
    case kZeroVelocity:
    case kZeroRate:
      return max_standstill_doubt_s_;
    case kForwardSpeed:
    case kLateral:
    case kVertical:
      return max_rejection_s_;
    default:
      return std::numeric_limits<double>::infinity();
  }
}

bool GatedUpdate::passes(MeasurementSet::Block& block, Nanoseconds stamp, ErrorCovariance& P) {
  const Measurement& m = block.measurement;
  ComponentStatus& status = status_[block.component];
  const std::optional<double> nis = normalizedInnovationSquared(m, P);
  if (!nis) {
    ++status.rejected;
    return false;
  }
  const double degrees = static_cast<double>(m.residual.size());
  status.last_nis = *nis / degrees;
  if (*nis <= limit(block)) {
    status.nis_sum += status.last_nis;
    ++status.accepted;
    status.rejected_since = 0;
    return true;
  }
  if (status.rejected_since == 0) {
    status.rejected_since = stamp;
  }
  if (toSeconds(stamp - status.rejected_since) >= patience(block.component)) {
    openCovariance(m, P);
    ++status.accepted;
    ++status.opened;
    return true;
  }
  ++status.rejected;
  return false;
}

std::optional<Measurement> GatedUpdate::select(MeasurementSet& set, Nanoseconds stamp, ErrorCovariance& P) {
  std::array<bool, 4> passed = {};
  int rows = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    passed[i] = passes(set[i], stamp, P);
    rows += passed[i] ? static_cast<int>(set[i].measurement.residual.size()) : 0;
  }
  if (rows == 0) {
    return std::nullopt;
  }
  Measurement stacked(rows);
  int row = 0;
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (!passed[i]) {
      continue;
    }
    const Measurement& m = set[i].measurement;
    const int n = static_cast<int>(m.residual.size());
    stacked.residual.segment(row, n) = m.residual;
    stacked.H.middleRows(row, n) = m.H;
    stacked.variance.segment(row, n) = set[i].variance_factor * m.variance;
    row += n;
  }
  return stacked;
}

}  // namespace slipnav
