#include "core/navigation/estimator.h"

#include <utility>

namespace slipnav {
namespace {

constexpr std::size_t kMaxFixes = 4096;
constexpr Nanoseconds kHandOverInterval = kSecond;
/// From a start until it is known; later fixes are of another session.
constexpr Nanoseconds kLongestDrive = 7200 * kSecond;

}  // namespace

Estimator::Estimator(const Planet& planet, const FilterSetup& setup, double patience_s)
    : engine_(planet, setup),
      patience_s_(patience_s),
      trusted_(patience_s),
      mechanization_limit_(setup.filter.max_wait_s) {}

bool Estimator::take(const Start& start) {
  if (start.number <= start_) {
    return false;
  }
  if (started_ && start.session == session_) {
    sessions_.pause();  // a new start without a new clock
  }
  start_ = start.number;
  session_ = start.session;
  has_steps_ = false;
  reissued_.reset();
  engine_.reset();
  started_ = start.state.has_value();
  if (!started_) {
    return true;
  }
  const InitialState& initial = *start.state;
  start_stamp_ = initial.nav.stamp;
  origin_ = initial.origin;
  handed_over_ = 0;
  trusted_ = SettledStamp(patience_s_);
  newest_end_ = 0;
  mechanization_limit_.restart(start_stamp_);
  sessions_.startNext([this](const WheelMotion& wheels) { use(wheels); });
  for (std::size_t i = 0; i < newest_fixes_.size(); ++i) {
    if (stampOf(newest_fixes_[i]) < start_stamp_ + kLongestDrive) {
      engine_.push(newest_fixes_[i]);
    }
  }
  engine_.initialize(initial);
  return true;
}

bool Estimator::isFirst(const InsStep& step) const { return step.epoch == 0 && step.start == start_stamp_; }

StepVerdict Estimator::push(std::uint32_t start, const InsStep& step, double now_s) {
  if (!started_ || start != start_) {
    return StepVerdict::kVoid;
  }
  const bool first = isFirst(step);
  if (!has_steps_ && !first) {
    return StepVerdict::kLost;
  }
  const Nanoseconds end = step.state.stamp;
  const bool restarted = has_steps_ && first && end > first_end_;
  if (!has_steps_ || restarted) {
    first_end_ = end;
    has_steps_ = true;
  }
  if (restarted) {
    mechanization_limit_.forgetSteps();
    reissued_ = engine_.reissue();
  }
  const bool is_void = step.epoch != engine_.epoch();
  if (!is_void) {
    engine_.push(step);
    mechanization_limit_.addStep(end);
    if (end > newest_end_) {
      newest_end_ = end;
      trusted_.push(end, now_s);
    }
  }
  return restarted ? StepVerdict::kRestarted : is_void ? StepVerdict::kVoid : StepVerdict::kTaken;
}

bool Estimator::push(const WheelMotion& wheels) {
  bool usable = true;
  sessions_.push(wheels, [this, &usable](const WheelMotion& passed) { usable = use(passed); });
  return usable;
}

bool Estimator::use(const WheelMotion& wheels) {
  const bool usable = engine_.push(wheels);
  if (usable) {
    mechanization_limit_.addWheels(wheels.stamp);
  }
  return usable;
}

bool Estimator::push(const AntennaFix& fix) {
  if (!newest_fixes_.empty() && stampOf(fix) <= stampOf(newest_fixes_.back()) - kRestartBackstep) {
    newest_fixes_.clear();
  }
  if (newest_fixes_.size() == kMaxFixes) {
    newest_fixes_.pop_front();
  }
  newest_fixes_.push_back(fix);
  return !started_ || engine_.push(fix);
}

std::optional<Reply> Estimator::advance(const FilterEngine::EstimateSink& sink, double now_s) {
  if (!has_steps_) {
    return std::nullopt;
  }
  if (reissued_) {
    return replyWith(std::exchange(reissued_, std::nullopt));
  }
  const std::optional<Correction> correction = engine_.advance(
      [this, &sink](const Estimate& estimate, const ErrorCovariance& P) {
        mechanization_limit_.processed(estimate.nav.stamp);
        sink(estimate, P);
      },
      trusted_.at(now_s));
  if (correction || mechanization_limit_.isStalled()) {
    return replyWith(correction);
  }
  return std::nullopt;
}

std::optional<Start> Estimator::handOver() {
  const Nanoseconds stamp = engine_.state().stamp;
  if (stamp - handed_over_ < kHandOverInterval) {
    return std::nullopt;
  }
  handed_over_ = stamp;
  Start present{start_, session_, engine_.snapshot()};
  present.state->origin = origin_;
  return present;
}

Reply Estimator::replyWith(const std::optional<Correction>& correction) {
  if (correction) {
    mechanization_limit_.forgetSteps();
  }
  const Reply reply{start_, correction, mechanization_limit_.runUntil()};
  mechanization_limit_.told(reply.run_until);
  return reply;
}

}  // namespace slipnav
