#pragma once
/// Mechanization and filter coupled in one thread: the offline counterpart of the nodelets Ins and Filter.

#include <memory>
#include <utility>

#include "core/navigation/estimator.h"
#include "core/navigation/mechanizer.h"

namespace slipnav {

/// A Mechanizer and an Estimator that pass steps and replies to each other.
class Navigator {
 public:
  Navigator(const Planet& planet, const ImuInputParams& imu, const FilterSetup& setup)
      : mechanizer_(planet, imu), estimator_(planet, setup) {}

  /// Buffered samples later than the initial state are used.
  void take(const Start& start);
  /// The same for a start of the present session.
  void initialize(const InitialState& initial);
  /// See FilterEngine.
  void onInnovation(InnovationSink sink) { estimator_.onInnovation(std::move(sink)); }
  void keepHistory(std::shared_ptr<FilterHistory> history) { estimator_.keepHistory(std::move(history)); }

  /// Each adds a sample and processes what has become certain by it.
  ImuVerdict push(const ImuSample& sample, const FilterEngine::EstimateSink& sink);
  bool push(const WheelMotion& wheels, const FilterEngine::EstimateSink& sink);
  bool push(const AntennaFix& fix) { return estimator_.push(fix); }

  /// Declares that nothing up to `stamp` is still to come, and processes it.
  void completeUpTo(Nanoseconds stamp, const FilterEngine::EstimateSink& sink);

  const FilterEngine& filter() const { return estimator_.engine(); }

 private:
  void pump(const FilterEngine::EstimateSink& sink);

  Mechanizer mechanizer_;
  Estimator estimator_;
};

}  // namespace slipnav
