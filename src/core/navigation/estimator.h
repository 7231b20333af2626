#pragma once
/// The filter between starts, steps, wheels and fixes, whatever their order of arrival.

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "core/navigation/exchange.h"
#include "core/navigation/mechanization_limit.h"
#include "core/navigation/settled_stamp.h"
#include "core/navigation/wheel_backlog.h"
#include "slipnav/core/ekf/engine/filter_engine.h"

namespace slipnav {

/// What becomes of a step.
enum class StepVerdict {
  kTaken,
  kVoid,       ///< of another start, or an older epoch
  kLost,       ///< the first steps since the start were missed: a new start is needed
  kRestarted,  ///< the mechanization was reloaded; the next reply tells it where to resume
};

/// Driven by the nodelet Filter, and by Navigator. The parameter `now_s` is any monotonic clock; without one, nothing
/// is still on its way.
class Estimator {
 public:
  /// @param patience_s how long a sensor must be silent by that clock before it is not waited for, see settled_stamp.h
  Estimator(const Planet& planet, const FilterSetup& setup, double patience_s = 0.0);

  /// @return whether it is a newer one: everything restarts from it, or ends
  bool take(const Start& start);

  /// @param start number of the start that the step follows from
  StepVerdict push(std::uint32_t start, const InsStep& step, double now_s = 0.0);
  /// In the time of the IMU. A sample of a session that has not started yet waits.
  /// @return false if it is unusable: not finite, repeated, or before what has been processed
  bool push(const WheelMotion& wheels);
  /// The newest fixes are kept for the next start, which becomes known later than they arrive. @return as above
  bool push(const AntennaFix& fix);

  /// Declares that no wheel sample and no fix up to `stamp` is still to come.
  void assumeCompleteUpTo(Nanoseconds stamp) { engine_.assumeCompleteUpTo(stamp); }

  /// Processes what has become certain. @return what the mechanization must know to continue
  std::optional<Reply> advance(const FilterEngine::EstimateSink& sink, double now_s = 0.0);

  /// Once a second of sensor time, the present estimate: with it, it can continue without this. Ask after each
  /// estimate.
  std::optional<Start> handOver();

  /// See FilterEngine.
  Reply place(const PoseOverride& pose) { return replyWith(engine_.place(pose)); }
  void retune(const FilterSetup& setup) { engine_.retune(setup); }
  void onInnovation(InnovationSink sink) { engine_.onInnovation(std::move(sink)); }
  void keepHistory(std::shared_ptr<FilterHistory> history) { engine_.keepHistory(std::move(history)); }

  bool isStarted() const { return started_; }
  /// Whether steps have come since the start.
  bool hasSteps() const { return has_steps_; }
  /// Number of the newest start.
  std::uint32_t start() const { return start_; }
  const FilterEngine& engine() const { return engine_; }

 private:
  bool isFirst(const InsStep& step) const;
  bool use(const WheelMotion& wheels);
  Reply replyWith(const std::optional<Correction>& correction);

  FilterEngine engine_;
  double patience_s_;
  SettledStamp trusted_;  ///< ends of steps
  MechanizationLimit mechanization_limit_;
  WheelBacklog sessions_;
  RingQueue<AntennaFix> newest_fixes_;
  bool started_ = false;
  bool has_steps_ = false;
  std::uint32_t start_ = 0;
  std::uint32_t session_ = 0;
  Nanoseconds start_stamp_ = 0;
  Geodetic origin_;
  Nanoseconds handed_over_ = 0;
  Nanoseconds first_end_ = 0;   ///< of the first step since the start
  Nanoseconds newest_end_ = 0;  ///< of all; those that come again need not wait again
  std::optional<Correction> reissued_;
};

}  // namespace slipnav
