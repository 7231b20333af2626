#include "slipnav/ins/imu_screen.h"

namespace slipnav {
namespace {

constexpr double kPeriodGain = 0.05;

}  // namespace

void ImuInputParams::visit(ParameterVisitor& v) {
  v.choice("sampling", sampling, {"mean", "instantaneous"},
           "whether a sample is the mean over the interval that ends at its stamp, or the value at its stamp");
  v.number("max_specific_force_mps2", max_specific_force_mps2, {1.0, 1e5}, "a larger magnitude is refused [m/s²]");
  v.number("max_rate_deg_per_s", max_rate_deg_per_s, {1.0, 1e6}, "a larger angular rate is refused [°/s]");
  v.number("gap_factor", gap_factor, {1.5, 100.0}, "an interval longer than this many usual ones counts as a gap");
  v.number("max_bridged_gap_s", max_bridged_gap_s, {0.0, 60.0}, "a longer gap is reported as a fault [s]");
}

const char* complaintOf(ImuVerdict verdict) {
  switch (verdict) {
    case ImuVerdict::kNotFinite:
      return "not a number or infinite";
    case ImuVerdict::kOutOfRange:
      return "beyond the range of the sensor";
    case ImuVerdict::kNotNewer:
      return "not newer than the sample before";
    case ImuVerdict::kTimeWentBack:
      return "the clock went back";
    case ImuVerdict::kAccepted:
    case ImuVerdict::kAfterGap:
      break;
  }
  return "";
}

void ImuScreen::reset() {
  newest_stamp_ = 0;
  period_s_ = 0.0;
}

ImuScreen::Result ImuScreen::check(const ImuSample& sample) {
  if (!sample.f_ib_b.allFinite() || !sample.omega_ib_b.allFinite()) {
    return {ImuVerdict::kNotFinite};
  }
  if (sample.f_ib_b.norm() > params_.max_specific_force_mps2 ||
      sample.omega_ib_b.norm() > degToRad(params_.max_rate_deg_per_s)) {
    return {ImuVerdict::kOutOfRange};
  }
  const bool is_first = newest_stamp_ == 0;
  const Nanoseconds since = sample.stamp - newest_stamp_;
  if (!is_first && since <= 0) {
    return {since <= -kRestartBackstep ? ImuVerdict::kTimeWentBack : ImuVerdict::kNotNewer};
  }
  newest_stamp_ = sample.stamp;
  if (is_first) {
    return {};
  }
  const double duration_s = toSeconds(since);
  if (period_s_ > 0.0 && duration_s > params_.gap_factor * period_s_) {
    return {ImuVerdict::kAfterGap, duration_s, duration_s - period_s_};
  }
  period_s_ += (period_s_ > 0.0 ? kPeriodGain : 1.0) * (duration_s - period_s_);
  return {ImuVerdict::kAccepted, duration_s, 0.0};
}

}  // namespace slipnav
