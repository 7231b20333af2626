#include "slipnav/ins/ins_engine.h"

#include <algorithm>

namespace slipnav {
namespace {

constexpr std::size_t kInitialRing = 4096;
constexpr std::size_t kLargestRing = 1U << 18U;  // four minutes at 1 kHz, while an initial state is waited for
constexpr Nanoseconds kRestartBackstep = 1'000'000'000;
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

InsEngine::InsEngine(const Planet& planet, const ImuInputParams& params)
    : strapdown_(planet), params_(params), ring_(kInitialRing) {}

void InsEngine::reset() {
  first_ = next_ = end_ = base_ = 0;
  epoch_ = 0;
  initialised_ = false;
  newest_stamp_ = 0;
  period_s_ = 0.0;
}

void InsEngine::initialise(const NavigationState& state) {
  dropUpTo(state.stamp);
  base_ = next_ = first_;
  epoch_ = 0;
  initial_ = state;
  initialised_ = true;
}

void InsEngine::dropUpTo(Nanoseconds stamp) {
  while (first_ < end_ && slot(first_).end <= stamp) {
    ++first_;
  }
}

void InsEngine::append(const Slot& new_slot) {
  if (end_ - first_ == ring_.size()) {
    makeRoom();
  }
  slot(end_++) = new_slot;
}

void InsEngine::makeRoom() {
  const bool mostly_waiting = next_ - first_ <= ring_.size() / 2;
  if (mostly_waiting && ring_.size() < kLargestRing) {
    std::vector<Slot> larger(2 * ring_.size());
    for (std::uint64_t i = first_; i < end_; ++i) {
      larger[i & (larger.size() - 1)] = slot(i);
    }
    ring_.swap(larger);
    return;
  }
  ++first_;
  next_ = std::max(next_, first_ + 1);
}

ImuVerdict InsEngine::push(const ImuSample& sample) {
  if (!sample.f_ib_b.allFinite() || !sample.omega_ib_b.allFinite()) {
    return ImuVerdict::kNotFinite;
  }
  if (sample.f_ib_b.norm() > params_.max_specific_force_mps2 ||
      sample.omega_ib_b.norm() > degToRad(params_.max_rate_deg_per_s)) {
    return ImuVerdict::kOutOfRange;
  }
  const Nanoseconds since = sample.stamp - newest_stamp_;
  if (newest_stamp_ != 0 && since <= 0) {
    return since <= -kRestartBackstep ? ImuVerdict::kTimeWentBack : ImuVerdict::kNotNewer;
  }
  const ImuSample before = newest_;
  const bool is_first = newest_stamp_ == 0;
  newest_ = sample;
  newest_stamp_ = sample.stamp;
  if (is_first) {
    return ImuVerdict::kAccepted;
  }
  const double duration_s = toSeconds(since);
  const bool gap = period_s_ > 0.0 && duration_s > params_.gap_factor * period_s_;
  if (!gap) {
    period_s_ += (period_s_ > 0.0 ? kPeriodGain : 1.0) * (duration_s - period_s_);
  }
  Slot added{sample.stamp, {sample.f_ib_b, sample.omega_ib_b, duration_s}, gap ? duration_s - period_s_ : 0.0, {}};
  if (gap || params_.sampling == "instantaneous") {
    added.interval.f_ib_b = 0.5 * (before.f_ib_b + sample.f_ib_b);
    added.interval.omega_ib_b = 0.5 * (before.omega_ib_b + sample.omega_ib_b);
  }
  append(added);
  return gap ? ImuVerdict::kAfterGap : ImuVerdict::kAccepted;
}

std::optional<InsStep> InsEngine::step() {
  if (!initialised_ || next_ == end_) {
    return std::nullopt;
  }
  const bool is_first = next_ == base_;
  Slot& current = slot(next_);
  const NavigationState& start = is_first ? initial_ : slot(next_ - 1).state;
  ImuInterval interval = current.interval;
  if (is_first) {  // the initial state may lie inside the interval of the sample that follows it
    interval.duration_s = toSeconds(current.end - start.stamp);
  }
  const ImuInterval previous = is_first ? ImuInterval{} : slot(next_ - 1).interval;
  current.state = strapdown_.propagate(start, previous, interval, current.end);

  InsStep result;
  result.sequence = next_ - base_;
  result.epoch = epoch_;
  result.start = start.stamp;
  result.state = current.state;
  result.f_ib_b = interval.f_ib_b - start.accel_bias_b;
  result.omega_ib_b = interval.omega_ib_b - start.gyro_bias_b;
  result.gap_s = current.gap_s;
  ++next_;
  return result;
}

bool InsEngine::correct(const Correction& correction) {
  const std::uint64_t index = base_ + correction.sequence;
  if (!initialised_ || index < first_ || index >= next_) {
    return false;
  }
  slot(index).state = correction.state;
  first_ = index;
  next_ = index + 1;
  epoch_ = correction.epoch;
  return true;
}

}  // namespace slipnav
