#include "core/navigation/starter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/text.h"

namespace slipnav {

Starter::Starter(const Planet& planet, const NavigationSetup& setup, const CheckpointParams& checkpoint,
                 std::uint32_t first)
    : initializer_(planet, setup.initialization, setup.imu_input, setup.filter),
      screen_(setup.imu_input),
      warm_start_(planet, checkpoint, setup.filter),
      warnings_(warm_start_.refused()),
      first_(first) {}

void Starter::push(const ImuSample& sample) {
  const ImuVerdict verdict = screen_.check(sample).verdict;
  if (verdict == ImuVerdict::kTimeWentBack) {
    initializer_.reset();
    warm_start_.forget();
    if (done_) {
      announce(std::nullopt);
    }
  }
  if (isAccepted(verdict)) {
    use(sample);
  }
}

template <class CoreSample>
void Starter::use(const CoreSample& sample) {
  if (done_) {
    initializer_.watch(sample);
  } else {
    initializer_.push(sample);
    announceResult();
  }
}

void Starter::push(const WheelMotion& wheels) { use(wheels); }

void Starter::push(const AntennaFix& fix) {
  if (!done_) {
    initializer_.push(fix);
    announceResult();
  }
}

void Starter::setTruth(const NavigationState& truth, bool has_attitude) {
  if (!done_) {
    initializer_.setTruth(truth, has_attitude);
    announceResult();
  }
}

void Starter::announceResult() {
  if (const std::optional<InitialState> initial = initializer_.result()) {
    announce(initial, "done");
  }
}

void Starter::announce(const std::optional<InitialState>& state, const std::string& how) {
  ++starts_;
  number_ = std::max(number_, first_) + 1;
  done_ = state.has_value();
  news_ = News{{number_, session(), state}, how};
}

void Starter::offer(const Start& running) {
  if (number_ == 0) {
    running_ = running;
  } else if (running.state && running.number == number_ && running.session == session()) {
    warm_start_.offer(*running.state);
  }
}

void Starter::resumeAt(Nanoseconds now) {
  if (now == 0) {
    return;
  }
  const std::optional<Start> running = std::exchange(running_, std::nullopt);
  // Unless it is from before the clock went back.
  if (number_ == 0 && running && running->state && now > running->state->nav.stamp - kRestartBackstep) {
    number_ = running->number;
    earlier_sessions_ = running->session - screen_.restarts();
    done_ = true;
    warm_start_.offer(*running->state);
    news_ = News{*running, "continued with the running estimate"};
  }
  if (done_ || !warm_start_.isPossible()) {
    return;
  }
  try {
    const InitialState initial = warm_start_.resume(now);
    const double unwatched_s = std::round(10.0 * warm_start_.unwatched()) / 10.0;
    announce(initial, "resumed " + formatNumber(unwatched_s) + " s after the last known state");
  } catch (const std::invalid_argument& error) {
    warnings_.push_back(std::string("a new start: ") + error.what());
  }
}

void Starter::replace(std::uint32_t number, Nanoseconds now) {
  if (!done_ || number != number_) {
    return;
  }
  done_ = false;
  resumeAt(now);
  if (!done_) {
    warnings_.push_back("the filter has lost the estimate: a new start");
    searchAgain();
  }
}

void Starter::searchAgain(bool forget_files) {
  initializer_.reset();
  forget_files ? warm_start_.deleteFiles() : warm_start_.forget();
  announce(std::nullopt);
}

}  // namespace slipnav
