#include "slipnav/core/navigation/pipeline.h"

#include <utility>

#include "core/navigation/navigator.h"
#include "core/navigation/starter.h"
#include "slipnav/core/ordering/imu_clock.h"

namespace slipnav {

struct Pipeline::Parts {
  Parts(const Planet& planet, const NavigationSetup& setup)
      : imu_clock(setup.imu_input.gap_factor),
        starter(planet, setup),
        navigator(planet, setup.imu_input, setup.filter) {}

  ImuClock imu_clock;
  Starter starter;
  Navigator navigator;
};

Pipeline::Pipeline(const Planet& planet, const NavigationSetup& setup, FilterEngine::EstimateSink sink)
    : parts_(std::make_unique<Parts>(planet, setup)),
      uses_fixes_(setup.filter.gnss.always()),
      sink_(std::move(sink)),
      health_(setup.filter) {}

Pipeline::Pipeline(const Pipeline& other)
    : parts_(std::make_unique<Parts>(*other.parts_)),
      uses_fixes_(other.uses_fixes_),
      sink_(other.sink_),
      initial_(other.initial_),
      counts_(other.counts_),
      health_(other.health_) {}

Pipeline::Pipeline(Pipeline&& other) noexcept = default;
Pipeline::~Pipeline() = default;

const Initializer& Pipeline::initializer() const { return parts_->starter.initializer(); }
const FilterEngine& Pipeline::filter() const { return parts_->navigator.filter(); }

void Pipeline::onInnovation(const InnovationSink& sink) { parts_->navigator.onInnovation(sink); }

void Pipeline::keepHistory(const std::shared_ptr<FilterHistory>& history) { parts_->navigator.keepHistory(history); }

void Pipeline::push(const ImuSample& sample) {
  ++counts_.imu;
  parts_->imu_clock.push(sample);
  while (const std::optional<ImuSample> corrected = parts_->imu_clock.pop()) {
    use(*corrected);
  }
  health_.noteStamps(parts_->imu_clock.faults(), sample.stamp);
}

void Pipeline::use(const ImuSample& sample) {
  const ImuVerdict verdict = parts_->navigator.push(sample, sink_);
  health_.noteImu(sample.stamp, verdict);
  health_.noteFilter(filter());
  if (verdict == ImuVerdict::kTimeWentBack) {
    health_.restart();
    ++counts_.restarts;
  }
  if (!isAccepted(verdict)) {
    ++counts_.rejected;
    return;
  }
  counts_.gaps += verdict == ImuVerdict::kAfterGap ? 1 : 0;
  parts_->starter.push(sample);
  takeNews();
  if (!initial_ && initializer().missesFixes()) {
    health_.note("gps/fix silent", sample.stamp);
  }
  if (!initializer().complaint().empty()) {
    health_.note(initializer().complaint(), sample.stamp);
  }
}

void Pipeline::push(const WheelMotion& wheels) {
  ++counts_.wheels;
  const bool taken = parts_->navigator.push(wheels, sink_);
  health_.noteWheels(wheels, taken);
  if (!taken) {
    ++counts_.rejected;
    return;
  }
  parts_->starter.push(wheels);
  takeNews();
}

void Pipeline::push(const AntennaFix& fix) {
  parts_->starter.push(fix);
  takeNews();
  if (uses_fixes_ && std::holds_alternative<PositionFix>(fix)) {
    parts_->navigator.push(fix);
  }
}

void Pipeline::setTruth(const NavigationState& truth, bool has_attitude) {
  parts_->starter.setTruth(truth, has_attitude);
  takeNews();
}

void Pipeline::takeNews() {
  if (const std::optional<Starter::News> news = parts_->starter.takeNews()) {
    parts_->navigator.take(news->start);
    initial_ = news->start.state;
  }
}

}  // namespace slipnav
