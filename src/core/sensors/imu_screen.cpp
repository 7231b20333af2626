#include "slipnav/core/sensors/imu_screen.h"

#include <algorithm>
#include <cmath>

namespace slipnav {
namespace {

/// Far below the noise of any IMU, in SI units; a quarter-turn mounting leaves traces of the other axes.
constexpr double kSame = 1e-9;

}  // namespace

void ImuInputParams::visit(ParameterVisitor& v) {
  v.choice("sampling", sampling, {"mean", "instantaneous"},
           "whether a sample is the mean over the interval that ends at its stamp, or the value at its stamp");
  v.number("max_specific_force_mps2", max_specific_force_mps2, {1.0, 1e5},
           "range of each accelerometer: samples at its limit are rejected [m/s²]");
  v.number("max_rate_deg_per_s", max_rate_deg_per_s, {1.0, 1e6},
           "range of each gyro: samples at its limit are rejected [°/s]");
  v.number("gap_factor", gap_factor, {1.5, 100.0}, "an interval longer than this many usual ones counts as a gap");
  v.number("max_bridged_gap_s", max_bridged_gap_s, {0.0, 60.0},
           "over a shorter gap the IMU samples are averaged; over a longer one, tilt and velocity are assumed "
           "constant [s]");
  v.integer("stuck_samples", stuck_samples, {0.0, 1e6},
            "an axis that repeats exactly the same value this often, while another changes, is stuck: samples are "
            "rejected until it changes; 0: never");
}

const char* complaintOf(ImuVerdict verdict) {
  switch (verdict) {
    case ImuVerdict::kNotFinite:
      return "not a number or infinite";
    case ImuVerdict::kOutOfRange:
      return "at the limit of the sensor's range";
    case ImuVerdict::kStuck:
      return "with a stuck axis";
    case ImuVerdict::kNotNewer:
      return "not newer than the previous one";
    case ImuVerdict::kTimeWentBack:
      return "with a clock that went back";
    case ImuVerdict::kAccepted:
    case ImuVerdict::kAfterGap:
      break;
  }
  return "";
}

void ImuScreen::Repeats::add(const Vector3& next) {
  for (std::size_t i = 0; i < count.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    count[i] = std::abs(next[axis] - value[axis]) < kSame ? count[i] + 1 : 0;
  }
  value = next;
}

bool ImuScreen::Repeats::isStuck(int limit) const {
  const auto [least, most] = std::minmax_element(count.begin(), count.end());
  return limit > 0 && *most >= limit && *least == 0;
}

bool ImuScreen::Repeats::areFrozen(int limit) const {
  return limit > 0 && *std::min_element(count.begin(), count.end()) >= limit;
}

bool ImuScreen::isFrozen() const {
  return force_.areFrozen(params_.stuck_samples) && rate_.areFrozen(params_.stuck_samples);
}

bool ImuScreen::isInRange(const ImuSample& sample) const {
  return sample.f_ib_b.cwiseAbs().maxCoeff() < params_.max_specific_force_mps2 &&
         sample.omega_ib_b.cwiseAbs().maxCoeff() < degToRad(params_.max_rate_deg_per_s);
}

void ImuScreen::reset() {
  force_ = Repeats();
  rate_ = Repeats();
  newest_ = ImuSample();
  usual_.reset();
}

ImuScreen::Result ImuScreen::check(const ImuSample& sample) {
  if (!sample.f_ib_b.allFinite() || !sample.omega_ib_b.allFinite()) {
    return {ImuVerdict::kNotFinite};
  }
  if (!isInRange(sample)) {
    return {ImuVerdict::kOutOfRange};
  }
  const bool restarts = newest_.stamp != 0 && sample.stamp <= newest_.stamp - kRestartBackstep;
  if (restarts) {
    reset();
    ++restarts_;
  }
  const ImuSample before = newest_;
  const bool is_first = before.stamp == 0;
  if (!is_first && sample.stamp <= before.stamp) {
    return {ImuVerdict::kNotNewer};
  }
  force_.add(sample.f_ib_b);
  rate_.add(sample.omega_ib_b);
  if (force_.isStuck(params_.stuck_samples) || rate_.isStuck(params_.stuck_samples)) {
    return {ImuVerdict::kStuck};
  }
  newest_ = sample;
  if (is_first) {
    return {restarts ? ImuVerdict::kTimeWentBack : ImuVerdict::kAccepted};
  }
  const double duration_s = toSeconds(sample.stamp - before.stamp);
  const double usual_s = usual_.value();
  usual_.add(duration_s);
  const bool after_gap = usual_s > 0.0 && duration_s > params_.gap_factor * usual_s;
  const ImuVerdict verdict = after_gap ? ImuVerdict::kAfterGap : ImuVerdict::kAccepted;
  const double gap_s = after_gap ? duration_s - usual_s : 0.0;
  if (after_gap || instantaneous_) {
    return {verdict,
            {0.5 * (before.f_ib_b + sample.f_ib_b), 0.5 * (before.omega_ib_b + sample.omega_ib_b), duration_s},
            gap_s};
  }
  return {verdict, {sample.f_ib_b, sample.omega_ib_b, duration_s}, gap_s};
}

}  // namespace slipnav
