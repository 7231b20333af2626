#pragma once
/// Stands between the operator and the rover, and stops the rover when a standstill is worth it.
///
/// driving → counting down → stopping → holding → driving; see doc/stop_supervisor.md for every rule. All times are
/// stamps of the estimates: decisions depend on what was observed, never on when it was computed.

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
  Nanoseconds stamp = 0;  ///< start of the forecast
  /// Until the error bound passes its threshold [s]; infinite if it does not within the horizon.
  double time_to_stop_s = std::numeric_limits<double>::infinity();
  double kept_s = 0.0;  ///< how long it is valid without another one
};

/// In the order of a stop.
enum class StopState { kDriving, kCountingDown, kStopping, kHolding };

/// The content of slipnav/StopStatus, in core types.
struct SupervisorStatus {
  Nanoseconds stamp = 0;  ///< of the newest estimate
  StopState state = StopState::kDriving;
  /// Until the stop begins, or at most of the hold [s]; infinite if no stop is due.
  double time_left_s = std::numeric_limits<double>::infinity();
  std::uint32_t stops = 0;     ///< that came to a standstill
  std::uint32_t refusals = 0;  ///< stops given up because the rover slid or did not come to rest
  bool overridden = false;
  bool emergency_stop = false;
  bool forecasts_stale = false;  ///< stops are periodic
  std::string reason;            ///< for the state, in words
};

/// Decides on each observation; reduces each command.
class StopSupervisor {
 public:
  explicit StopSupervisor(const StopParams& params);

  /// Other limits and times from now on. A stop in progress ends if the mode changes.
  void retune(const StopParams& params);

  /// Each estimate, in order. One whose stamp goes back by a second or more restarts; other old ones are ignored.
  void observe(const RoverObservation& observation);
  /// Estimates have stopped: no stop begins until one arrives. One in progress continues within its limit.
  void loseEstimates();
  /// This much time has passed without estimates; ignored while there are some.
  void passTime(Nanoseconds elapsed);
  /// Replaces the previous one. Ignored if its time is not a number, or if it is ahead of the estimates or
  /// older than the previous one: then it belongs to another session.
  void setForecast(const StopForecast& forecast);

  /// The command for the rover, given the operator's command now; never more than that. A command that is
  /// not finite is rejected, which gives zero.
  VelocityCommand command(const VelocityCommand& in);

  /// The operator requests a stop for a zero update now. @return why there will be none, "" if there will
  std::string stopNow();
  /// While overridden, commands pass and no stop is made; one in progress ends at once.
  void setOverride(bool overridden);
  /// While set, every command becomes zero at once, in every mode.
  void setEmergencyStop(bool stop);
  /// The operator's decisions before a restart.
  void restore(const StopLatch& latch);
  /// What must survive the next one.
  StopLatch latch() const { return {status_.emergency_stop, status_.overridden}; }

  /// For nodes that count down to a stop [s]: 0 while the rover stops, stands, or must not drive; at most
  /// `no_stop_due_s`; nothing if nothing is known. Never infinite, which ends their countdown.
  std::optional<double> countdown_s() const;

  /// The speed commanded while the rover is being stopped [m/s]; nothing otherwise.
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
  Nanoseconds clock_ = 0;  ///< stamp of the newest estimate plus the time passed since without any
  VelocityCommand last_out_;
  Nanoseconds driving_since_ = 0;  ///< the last standstill that converged, or the start
  Nanoseconds not_before_ = 0;     ///< earliest next stop
  std::string given_up_;           ///< why the last stop was given up, until then
  Nanoseconds requested_ = 0;      ///< start of the stop in progress
  std::optional<Nanoseconds> holding_since_;
};

}  // namespace slipnav
