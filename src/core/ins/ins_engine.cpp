#include "slipnav/core/ins/ins_engine.h"

#include <algorithm>

namespace slipnav {
namespace {

constexpr std::size_t kInitialRing = 4096;
constexpr std::size_t kLargestRing = 1U << 18U;  // four minutes at 1 kHz, while waiting for an initial state

}  // namespace

InsEngine::InsEngine(const Planet& planet, const ImuInputParams& params)
    : strapdown_(planet),
      screen_(params),
      instantaneous_(params.sampling == "instantaneous"),
      gap_factor_(params.gap_factor),
      max_bridged_gap_s_(params.max_bridged_gap_s),
      ring_(kInitialRing) {}

void InsEngine::reset() {
  first_ = next_ = end_ = begin_ = base_ = 0;
  epoch_ = 0;
  initialised_ = false;
  screen_.reset();
}

void InsEngine::initialise(const NavigationState& state) {
  dropUpTo(state.stamp);
  begin_ = base_ = next_ = first_;
  epoch_ = 0;
  initial_ = state;
  initialised_ = true;
}

void InsEngine::adopt(const Correction& correction) {
  initialise(correction.state);
  base_ = begin_ - (correction.sequence + 1);
  epoch_ = correction.epoch;
}

ImuInterval InsEngine::steadyTurn(const NavigationState& state, const ImuInterval& interval) const {
  const Planet& planet = strapdown_.planet();
  const Quaternion q_n_to_b = state.q_b_to_n.conjugate();
  const Vector3 down_b = q_n_to_b * Vector3::UnitZ();
  const Vector3 omega_ie_b = q_n_to_b * planet.omega_ie_n(state.position.latitude_rad);
  const double turn_radps = down_b.dot(interval.omega_ib_b - state.gyro_bias_b - omega_ie_b);
  const Vector3 turn_b = turn_radps * down_b;
  return {state.accel_bias_b - q_n_to_b * planet.gravity_n(state.position), state.gyro_bias_b + omega_ie_b + turn_b,
          interval.duration_s};
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
  const ImuSample before = newest_;
  const ImuScreen::Result result = screen_.check(sample);
  if (!isAccepted(result.verdict)) {
    return result.verdict;
  }
  newest_ = sample;
  if (result.duration_s > 0.0) {
    Slot added{sample.stamp, {sample.f_ib_b, sample.omega_ib_b, result.duration_s}, result.gap_s, {}};
    if (result.verdict == ImuVerdict::kAfterGap || instantaneous_) {
      added.interval.f_ib_b = 0.5 * (before.f_ib_b + sample.f_ib_b);
      added.interval.omega_ib_b = 0.5 * (before.omega_ib_b + sample.omega_ib_b);
    }
    append(added);
  }
  return result.verdict;
}

std::optional<InsStep> InsEngine::step() {
  if (!initialised_ || next_ == end_) {
    return std::nullopt;
  }
  const bool is_first = next_ == begin_;
  Slot& current = slot(next_);
  const NavigationState& start = is_first ? initial_ : slot(next_ - 1).state;
  ImuInterval interval = current.interval;
  double gap_s = current.gap_s;
  if (is_first) {  // the initial state may lie inside the interval of the next sample, or before it
    const double duration_s = toSeconds(current.end - start.stamp);
    if (duration_s > gap_factor_ * interval.duration_s) {
      gap_s = duration_s - interval.duration_s;
    }
    interval.duration_s = duration_s;
  }
  if (gap_s > max_bridged_gap_s_) {
    interval = steadyTurn(start, interval);
  }
  // The rates before a gap say nothing about those in it.
  const ImuInterval previous = is_first || gap_s > 0.0 ? ImuInterval{} : slot(next_ - 1).interval;
  if (current.gap_s > kLongestGap_s) {
    current.state = start;
    current.state.stamp = current.end;
  } else {
    current.state = strapdown_.propagate(start, previous, interval, current.end);
  }

  InsStep result;
  result.sequence = next_ - base_;
  result.epoch = epoch_;
  result.start = start.stamp;
  result.state = current.state;
  result.f_ib_b = interval.f_ib_b - start.accel_bias_b;
  result.omega_ib_b = interval.omega_ib_b - start.gyro_bias_b;
  result.gap_s = gap_s;
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
