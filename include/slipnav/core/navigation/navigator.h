#pragma once
/// Mechanization and filter coupled in one thread: the offline counterpart of the nodelets.

#include <memory>
#include <utility>

#include "slipnav/core/ekf/engine/filter_engine.h"
#include "slipnav/core/ins/ins_engine.h"

namespace slipnav {

/// An InsEngine and a FilterEngine that pass steps and corrections to each other.
class Navigator {
 public:
  Navigator(const Planet& planet, const ImuInputParams& imu, const FilterSetup& setup);

  /// Buffered samples later than the initial state are used.
  void initialise(const InitialState& initial);
  /// See FilterEngine.
  void onInnovation(InnovationSink sink) { filter_.onInnovation(std::move(sink)); }
  void keepHistory(std::shared_ptr<FilterHistory> history) { filter_.keepHistory(std::move(history)); }
  bool isInitialised() const { return filter_.isInitialised(); }

  /// Each adds a sample and processes what has become certain by it.
  ImuVerdict push(const ImuSample& sample, const FilterEngine::EstimateSink& sink);
  bool push(const WheelMotion& wheels, const FilterEngine::EstimateSink& sink);
  bool push(const AntennaFix& fix) { return filter_.push(fix); }

  /// Declares that nothing up to `stamp` is still to come, and processes it.
  void completeUpTo(Nanoseconds stamp, const FilterEngine::EstimateSink& sink);

  const FilterEngine& filter() const { return filter_; }

 private:
  void pump(const FilterEngine::EstimateSink& sink);

  InsEngine ins_;
  FilterEngine filter_;
};

}  // namespace slipnav
