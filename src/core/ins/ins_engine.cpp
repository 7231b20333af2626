#include "slipnav/core/ins/ins_engine.h"

namespace slipnav {
namespace {

constexpr std::size_t kMaxMechanized = 4096;
constexpr std::size_t kMaxSlots = 1U << 18U;  // four minutes at 1 kHz, while waiting for an initial state

}  // namespace

void InsEngine::initialize(const NavigationState& state) {
  while (!slots_.empty() && slots_.front().end <= state.stamp) {
    slots_.pop_front();
  }
  next_ = 0;
  epoch_ = 0;
  initial_ = state;
  initialized_ = true;
}

void InsEngine::adopt(const Correction& correction) {
  initialize(correction.state);
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

void InsEngine::append(const Slot& slot) {
  if (next_ > kMaxMechanized || slots_.size() >= kMaxSlots) {
    if (next_ > 0) {
      initial_ = slots_.front().state;
      --next_;
    }
    slots_.pop_front();
  }
  slots_.push_back(slot);
}

ImuVerdict InsEngine::push(const ImuSample& sample) {
  const ImuScreen::Result result = screen_.check(sample);
  if (result.verdict == ImuVerdict::kTimeWentBack) {
    slots_.clear();
    next_ = 0;
    initialized_ = false;
  }
  if (isAccepted(result.verdict) && result.interval.duration_s > 0.0) {
    append({sample.stamp, result.interval, result.gap_s, {}});
  }
  return result.verdict;
}

std::optional<InsStep> InsEngine::step() {
  if (!initialized_ || next_ == slots_.size()) {
    return std::nullopt;
  }
  const bool is_first = next_ == 0;
  Slot& current = slots_[next_];
  const NavigationState& start = is_first ? initial_ : slots_[next_ - 1].state;
  ImuInterval interval = current.interval;
  double gap_s = current.gap_s;
  if (is_first) {  // the initial state may lie inside the interval of the next sample, or before it
    const double duration_s = toSeconds(current.end - start.stamp);
    if (duration_s > params_.gap_factor * interval.duration_s) {
      gap_s = duration_s - interval.duration_s;
    }
    interval.duration_s = duration_s;
  }
  if (gap_s > params_.max_bridged_gap_s) {
    interval = steadyTurn(start, interval);
  }
  // The rates before a gap say nothing about those in it.
  const ImuInterval previous = is_first || gap_s > 0.0 ? ImuInterval{} : slots_[next_ - 1].interval;
  if (current.gap_s > kLongestGap_s) {
    current.state = start;
    current.state.stamp = current.end;
  } else {
    current.state = strapdown_.propagate(start, previous, interval, current.end);
  }

  InsStep result;
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
  std::size_t index = 0;
  while (index < next_ && slots_[index].end < correction.state.stamp) {
    ++index;
  }
  if (!initialized_ || index == next_ || slots_[index].end != correction.state.stamp) {
    return false;
  }
  for (; index > 0; --index) {
    slots_.pop_front();
  }
  slots_.front().state = correction.state;
  next_ = 1;
  epoch_ = correction.epoch;
  return true;
}

}  // namespace slipnav
