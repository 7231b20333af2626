#include "core/navigation/navigator.h"

namespace slipnav {

void Navigator::take(const Start& start) {
  mechanizer_.take(start);
  estimator_.take(start);
}

void Navigator::initialize(const InitialState& initial) {
  take({estimator_.start() + 1, mechanizer_.session(), initial});
}

ImuVerdict Navigator::push(const ImuSample& sample, const FilterEngine::EstimateSink& sink) {
  const ImuVerdict verdict = mechanizer_.push(sample);
  pump(sink);
  return verdict;
}

bool Navigator::push(const WheelMotion& wheels, const FilterEngine::EstimateSink& sink) {
  const bool taken = estimator_.push(wheels);
  pump(sink);
  return taken;
}

void Navigator::completeUpTo(Nanoseconds stamp, const FilterEngine::EstimateSink& sink) {
  estimator_.assumeCompleteUpTo(stamp);
  pump(sink);
}

void Navigator::pump(const FilterEngine::EstimateSink& sink) {
  const auto push = [this](const InsStep& step) { estimator_.push(mechanizer_.start(), step); };
  std::optional<Reply> reply;
  do {
    if (reply) {
      mechanizer_.take(*reply);
    }
    mechanizer_.run(push);
    reply = estimator_.advance(sink);
  } while (reply);
}

}  // namespace slipnav
