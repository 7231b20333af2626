#pragma once
/// Mechanizes what the estimator needs, from where the starter says.

#include <cstdint>
#include <functional>
#include <optional>

#include "core/navigation/exchange.h"

namespace slipnav {

/// Driven by the nodelet Ins, and by Navigator.
class Mechanizer {
 public:
  Mechanizer(const Planet& planet, const ImuInputParams& params) : engine_(planet, params) {}

  /// A sample in order of time. @param now_s any monotonic clock, wherever this occurs; matters to reloaded nodelets
  /// only
  ImuVerdict push(const ImuSample& sample, double now_s = 0.0);

  /// A start is used once the samples have reached it, if they are of the same session.
  void take(const Start& start, double now_s = 0.0);

  /// @return false if it corrects a step that is not known here: then the steps continue from its state
  bool take(const Reply& reply);

  /// Passes the steps that are needed, as far as there are samples, to `sink`.
  void run(const std::function<void(const InsStep&)>& sink);

  bool isRunning() const { return engine_.isInitialized(); }
  /// Number of the start in use.
  std::uint32_t start() const { return start_; }
  /// How often the clock of the IMU has restarted.
  std::uint32_t session() const { return earlier_sessions_ + engine_.restarts(); }
  const InsEngine& engine() const { return engine_; }

 private:
  void startIfDue(double now_s);
  bool isOfThisSession(const Start& start, double now_s);

  InsEngine engine_;
  std::optional<Start> next_;  ///< not yet used
  double next_came_s_ = 0.0;
  std::uint32_t newest_start_ = 0;      ///< number of the newest one received
  std::uint32_t start_ = 0;             ///< number of the one in use
  std::uint32_t earlier_sessions_ = 0;  ///< before the first sample
  Nanoseconds newest_step_ = 0;         ///< end of it
  Nanoseconds run_until_ = 0;
};

}  // namespace slipnav
