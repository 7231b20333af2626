#include "core/navigation/mechanizer.h"

namespace slipnav {
namespace {

/// [s] of real time after which a start of a later session, where none was ever used, is taken for one of the present
/// session: this may have been loaded in the middle of it.
constexpr double kSessionPatience_s = 2.0;

}  // namespace

ImuVerdict Mechanizer::push(const ImuSample& sample, double now_s) {
  const ImuVerdict verdict = engine_.push(sample);
  startIfDue(now_s);
  return verdict;
}

void Mechanizer::take(const Start& start, double now_s) {
  if (start.number <= newest_start_) {
    return;
  }
  newest_start_ = start.number;
  next_.reset();
  if (start.state) {
    next_ = start;
    next_came_s_ = now_s;
    startIfDue(now_s);
  } else if (start.session == session()) {
    engine_.release();
  }
}

void Mechanizer::startIfDue(double now_s) {
  if (!next_ || !isOfThisSession(*next_, now_s) || engine_.newestStamp() < next_->state->nav.stamp) {
    return;
  }
  engine_.initialize(next_->state->nav);
  start_ = next_->number;
  newest_step_ = next_->state->nav.stamp;
  run_until_ = newest_step_ + 1;
  next_.reset();
}

bool Mechanizer::isOfThisSession(const Start& start, double now_s) {
  const bool never_started = start_ == 0;
  if (never_started && start.session > session() && now_s - next_came_s_ >= kSessionPatience_s) {
    earlier_sessions_ = start.session - engine_.restarts();
  }
  return start.session == session();
}

bool Mechanizer::take(const Reply& reply) {
  if (reply.start != start_ || !engine_.isInitialized()) {
    return true;
  }
  bool known = true;
  if (reply.correction) {
    known = engine_.correct(*reply.correction);
    if (!known) {
      engine_.adopt(*reply.correction);
    }
    newest_step_ = reply.correction->state.stamp;
  }
  run_until_ = reply.run_until;
  return known;
}

void Mechanizer::run(const std::function<void(const InsStep&)>& sink) {
  while (newest_step_ < run_until_) {
    const std::optional<InsStep> step = engine_.step();
    if (!step) {
      return;
    }
    newest_step_ = step->state.stamp;
    sink(*step);
  }
}

}  // namespace slipnav
