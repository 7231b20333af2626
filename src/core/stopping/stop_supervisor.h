#pragma once
/// Stands between the operator and the rover, and stops the rover when a standstill pays.
///
/// driving → counting down → stopping → holding → driving; see doc/stop_supervisor.md for every rule. All times are
/// stamps of the estimates: what is decided depends on what was observed, never on when it was computed.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "core/stopping/release_ramp.h"
#include "core/stopping/rover_observation.h"
#include "core/stopping/standstill.h"
#include "core/stopping/stop_latch.h"
#include "core/stopping/stop_params.h"
#include "core/stopping/stop_ramp.h"
#include "core/stopping/velocity_command.h"

namespace slipnav {

/// What the supervisor takes from a forecast of the position error.
struct StopForecast {
  Nanoseconds stamp = 0;  ///< when it begins
  /// Until the error bound passes its threshold [s]; infinite when it does not within the horizon.
  double time_to_stop_s = std::numeric_limits<double>::infinity();
  double kept_s = 0.0;  ///< so long it holds without another one
};

/// In the order in which a stop goes through them.
enum class StopState { kDriving, kCountingDown, kStopping, kHolding };

/// What slipnav/StopStatus says, in core types.
struct SupervisorStatus {
  Nanoseconds stamp = 0;  ///< of the newest estimate
  StopState state = StopState::kDriving;
  /// Until the stop begins, or at most of the hold [s]; infinite when no stop is due.
  double time_left_s = std::numeric_limits<double>::infinity();
  std::uint32_t stops = 0;     ///< that came to a standstill
  std::uint32_t refusals = 0;  ///< that were given up because the rover slid or did not come to rest
  bool overridden = false;
  bool emergency_stop = false;
  bool forecasts_stale = false;  ///< stops are periodic
  std::string reason;            ///< for the state, in words
};

/// Decides on each observation; shortens each command.
class StopSupervisor {
 public:
  explicit StopSupervisor(const StopParams& params);

  /// Other limits and times from now on. A stop that is under way when the mode changes ends.
  void retune(const StopParams& params);

  /// Each estimate, in order. One whose stamp goes back by a second or more begins anew; other old ones are ignored.
  void observe(const RoverObservation& observation);
  /// No estimate comes any more: no stop begins until one does. One that is under way goes on within its limit.
  void loseEstimates();
  /// So much time has passed without estimates; ignored while there are some.
  void passTime(Nanoseconds elapsed);
  /// Takes the place of the one before. Ignored when its time is not a number, or when it is ahead of the estimates or
  /// older than the one before: then it belongs to another session.
  void setForecast(const StopForecast& forecast);

  /// What the rover shall be told in place of what the operator commands now; never more than that. A command that is
  /// not finite is refused, which gives zero.
  VelocityCommand command(const VelocityCommand& in);

  /// The operator wants a stop for a zero update now. @return why there will be none, "" when there will
  std::string stopNow();
  /// While overridden, commands pass and no stop is made; one that is under way ends at once.
  void setOverride(bool overridden);
  /// While set, every command becomes zero at once, in every mode.
  void setEmergencyStop(bool stop);
  /// What the operator had said before a restart.
  void restore(const StopLatch& latch);
  /// What has to survive the next one.
  StopLatch latch() const { return {status_.emergency_stop, status_.overridden}; }

  /// For those who count down to a stop [s]: 0 while the rover stops, stands, or must not drive; at most
  /// `no_stop_due_s`; nothing when nothing is known. Never infinite, which ends their counting.
  std::optional<double> countdown_s() const;

  /// The speed that the rover is told while it is being stopped [m/s]; nothing otherwise.
  std::optional<double> told_mps() const;

  const SupervisorStatus& status() const { return status_; }
  StopMode mode() const { return mode_; }

 private:
  /// A stop that may come.
  struct Plan {
    Nanoseconds due;
    const char* reason;
  };

  void advance();
  void restart(Nanoseconds stamp);
  bool isStopping() const { return status_.state >= StopState::kStopping; }
  bool hasConverged() const;
  double sinceRelease_s() const { return toSeconds(status_.stamp - driving_since_); }
  void watchForecasts();
  const char* obstacle() const;
  const char* whyNoPlan() const;
  std::optional<Plan> plan() const;
  double brakingTime_s() const;
  void considerStop();
  void requestStop(const char* reason);
  void considerHold();
  void considerRelease();
  VelocityCommand commandWhileDriving(const VelocityCommand& in);
  void release(const std::string& reason);
  void giveUp(const std::string& reason);

  StopParams params_;
  StopMode mode_;
  SupervisorStatus status_;
  bool has_estimates_ = false;
  RoverObservation newest_;
  Standstill standstill_;
  std::optional<StopForecast> forecast_;
  StopRamp ramp_;
  ReleaseRamp release_ramp_;
  Nanoseconds clock_ = 0;  ///< stamp of the newest estimate, and what has passed since without any
  VelocityCommand last_out_;
  Nanoseconds driving_since_ = 0;  ///< the last standstill that converged, or the begin
  Nanoseconds not_before_ = 0;     ///< earliest next stop
  std::string given_up_;           ///< why the last stop was, until then
  Nanoseconds requested_ = 0;      ///< begin of the stop that is under way
  std::optional<Nanoseconds> holding_since_;
};

}  // namespace slipnav
