#include "slipnav/core/navigation/navigator.h"

namespace slipnav {

Navigator::Navigator(const Planet& planet, const ImuInputParams& imu, const FilterSetup& setup)
    : ins_(planet, imu), filter_(planet, setup) {}

void Navigator::initialise(const InitialState& initial) {
  ins_.initialise(initial.nav);
  filter_.initialise(initial);
}

ImuVerdict Navigator::push(const ImuSample& sample, const FilterEngine::EstimateSink& sink) {
  const ImuVerdict verdict = ins_.push(sample);
  pump(sink);
  return verdict;
}

bool Navigator::push(const WheelMotion& wheels, const FilterEngine::EstimateSink& sink) {
  const bool taken = filter_.push(wheels);
  pump(sink);
  return taken;
}

void Navigator::completeUpTo(Nanoseconds stamp, const FilterEngine::EstimateSink& sink) {
  filter_.assumeCompleteUpTo(stamp);
  pump(sink);
}

void Navigator::pump(const FilterEngine::EstimateSink& sink) {
  std::optional<Correction> correction;
  do {
    if (correction) {
      ins_.correct(*correction);
    }
    while (const std::optional<InsStep> step = ins_.step()) {
      filter_.push(*step);
    }
    correction = filter_.advance(sink);
  } while (correction);
}

}  // namespace slipnav
