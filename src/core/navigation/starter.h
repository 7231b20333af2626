#pragma once
/// Says where an estimate starts, and when it ends: by the initializer, or by resuming an estimate that ended.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/navigation/exchange.h"
#include "core/navigation/warm_start.h"
#include "slipnav/core/navigation/initializer.h"

namespace slipnav {

/// Driven by the nodelet Initializer, and by Pipeline. Numbers the starts, and counts the sessions.
class Starter {
 public:
  /// @param first starts are numbered from here on
  Starter(const Planet& planet, const NavigationSetup& setup, const CheckpointParams& checkpoint = {},
          std::uint32_t first = 0);

  /// Samples in order of stamp, of all sensors together.
  void push(const ImuSample& sample);
  void push(const WheelMotion& wheels);
  void push(const AntennaFix& fix);
  /// See Initializer.
  void setTruth(const NavigationState& truth, bool has_attitude);
  void retune(const FilterSetup& setup) { initializer_.retune(setup); }

  /// What the filter hands over: the present estimate, to resume from if it ends. Before the first start, an estimate
  /// that is running already.
  void offer(const Start& running);
  /// IMU samples have come up to `now`: continues with the running estimate or resumes one, if there is any.
  void resumeAt(Nanoseconds now);
  /// The filter has lost the estimate of the start with this number, and requests a new one.
  void replace(std::uint32_t number, Nanoseconds now);
  /// Ends the estimate and searches for a new start. @param forget_files also deletes checkpoints
  void searchAgain(bool forget_files = false);

  /// A start, or the end of the estimate.
  struct News {
    Start start;
    std::string how;  ///< the start was found
  };
  /// The news since the last call.
  std::optional<News> takeNews() { return std::exchange(news_, std::nullopt); }
  /// Why an estimate was not resumed, one line each, since the last call.
  std::vector<std::string> takeWarnings() { return std::exchange(warnings_, {}); }

  bool isDone() const { return done_; }
  /// Starts found, and searches restarted.
  std::uint32_t starts() const { return starts_; }
  /// How often the clock of the IMU has gone back.
  std::uint32_t session() const { return earlier_sessions_ + screen_.restarts(); }
  Nanoseconds newestStamp() const { return screen_.newestStamp(); }
  const Initializer& initializer() const { return initializer_; }

 private:
  template <class CoreSample>
  void use(const CoreSample& sample);
  void announceResult();
  void announce(const std::optional<InitialState>& state, const std::string& how = "");

  Initializer initializer_;
  ImuScreen screen_;
  WarmStart warm_start_;
  std::optional<Start> running_;  ///< of the estimate that was running before
  std::optional<News> news_;
  std::vector<std::string> warnings_;
  std::uint32_t first_;
  std::uint32_t number_ = 0;  ///< of the newest start, 0: none so far
  std::uint32_t starts_ = 0;
  std::uint32_t earlier_sessions_ = 0;
  bool done_ = false;
};

}  // namespace slipnav
