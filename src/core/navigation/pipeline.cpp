#include "slipnav/core/navigation/pipeline.h"

#include <utility>

namespace slipnav {

Pipeline::Pipeline(const Planet& planet, const NavigationSetup& setup, FilterEngine::EstimateSink sink)
    : planet_(planet),
      setup_(setup),
      sink_(std::move(sink)),
      imu_clock_(setup.imu_input.gap_factor),
      initializer_(planet, setup.initialization, setup.imu_input, setup.filter),
      navigator_(planet, setup.imu_input, setup.filter),
      health_(setup.filter) {}

void Pipeline::onInnovation(const InnovationSink& sink) {
  on_innovation_ = sink;
  navigator_.onInnovation(sink);
}

void Pipeline::keepHistory(const std::shared_ptr<FilterHistory>& history) {
  history_ = history;
  navigator_.keepHistory(history);
}

void Pipeline::restart() {
  initializer_.reset();
  navigator_ = Navigator(planet_, setup_.imu_input, setup_.filter);
  navigator_.onInnovation(on_innovation_);
  navigator_.keepHistory(history_);
  initial_.reset();
  health_.restart();
  ++counts_.restarts;
}

void Pipeline::push(const ImuSample& sample) {
  ++counts_.imu;
  imu_clock_.push(sample);
  while (const std::optional<ImuSample> corrected = imu_clock_.pop()) {
    use(*corrected);
  }
  health_.noteStamps(imu_clock_.faults(), sample.stamp);
}

void Pipeline::use(const ImuSample& sample) {
  ImuVerdict verdict = navigator_.push(sample, sink_);
  health_.noteImu(sample.stamp, verdict);
  health_.noteFilter(navigator_.filter());
  if (verdict == ImuVerdict::kTimeWentBack) {
    restart();
    verdict = navigator_.push(sample, sink_);
  }
  if (!isAccepted(verdict)) {
    ++counts_.rejected;
    return;
  }
  counts_.gaps += verdict == ImuVerdict::kAfterGap ? 1 : 0;
  if (!initial_) {
    initializer_.push(sample);
    if (initializer_.missesFixes()) {
      health_.note("gps/fix silent", sample.stamp);
    }
    tryToStart();
  } else {
    initializer_.watch(sample);
  }
  if (!initializer_.complaint().empty()) {
    health_.note(initializer_.complaint(), sample.stamp);
  }
}

void Pipeline::push(const WheelMotion& wheels) {
  ++counts_.wheels;
  const bool taken = navigator_.push(wheels, sink_);
  health_.noteWheels(wheels, taken);
  if (!taken) {
    ++counts_.rejected;
    return;
  }
  if (!initial_) {
    initializer_.push(wheels);
    tryToStart();
  } else {
    initializer_.watch(wheels);
  }
}

void Pipeline::push(const AntennaFix& fix) {
  if (!initial_) {
    initializer_.push(fix);
    tryToStart();
  }
  if (setup_.filter.gnss.always() && std::holds_alternative<PositionFix>(fix)) {
    navigator_.push(fix);
  }
}

void Pipeline::setTruth(const NavigationState& truth, bool has_attitude) {
  if (!initial_) {
    initializer_.setTruth(truth, has_attitude);
    tryToStart();
  }
}

void Pipeline::tryToStart() {
  initial_ = initializer_.result();
  if (initial_) {
    navigator_.initialise(*initial_);
  }
}

}  // namespace slipnav
