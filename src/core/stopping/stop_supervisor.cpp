#include "core/stopping/stop_supervisor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace slipnav {
namespace {

constexpr double kNever_s = std::numeric_limits<double>::infinity();
/// A stop beyond the reach of any forecast does not count; its stamp could overflow.
constexpr double kFarthestStop_s = 1e6;

std::string seconds(double s) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", s);
  return text;
}

}  // namespace

StopSupervisor::StopSupervisor(const StopParams& params)
    : params_(params), mode_(params.stopMode()), ramp_(params.deceleration_mps2, params.angular_deceleration_radps2) {
  status_.reason = whyNoPlan();
}

void StopSupervisor::retune(const StopParams& params) {
  params_ = params;
  ramp_.retune(params.deceleration_mps2, params.angular_deceleration_radps2);
  if (params.stopMode() == mode_) {
    return;
  }
  mode_ = params.stopMode();
  if (isStopping()) {
    release("");
  }
  if (!status_.emergency_stop) {
    release_ramp_.end();
  }
  advance();
}

void StopSupervisor::restart(Nanoseconds stamp) {
  const SupervisorStatus before = status_;
  status_ = SupervisorStatus{};
  status_.overridden = before.overridden;
  status_.emergency_stop = before.emergency_stop;
  standstill_ = Standstill{};
  forecast_.reset();
  holding_since_.reset();
  given_up_.clear();
  driving_since_ = stamp;
  not_before_ = stamp + fromSeconds(params_.min_drive_s);
  if (before.state >= StopState::kStopping && mode_ == StopMode::kActive) {
    release_ramp_.begin(stamp);
  }
}

void StopSupervisor::observe(const RoverObservation& observation) {
  const bool first = newest_.stamp == 0;
  if (first || observation.stamp <= newest_.stamp - kRestartBackstep) {
    restart(observation.stamp);
  } else if (observation.stamp <= newest_.stamp) {
    return;
  }
  has_estimates_ = true;
  requested_ -= std::max<Nanoseconds>(0, clock_ - observation.stamp);  // time without estimates counts
  newest_ = observation;
  clock_ = observation.stamp;
  status_.stamp = observation.stamp;
  standstill_.observe(observation);
  advance();
}

void StopSupervisor::loseEstimates() {
  has_estimates_ = false;
  if (isStopping() && (status_.state == StopState::kHolding || mode_ != StopMode::kActive)) {
    release("");
  }
  advance();
}

void StopSupervisor::passTime(Nanoseconds elapsed) {
  if (has_estimates_ || elapsed <= 0) {
    return;
  }
  clock_ += elapsed;
  if (isStopping() && toSeconds(clock_ - requested_) >= params_.max_stop_s) {
    release("");
  }
  advance();
}

void StopSupervisor::setForecast(const StopForecast& forecast) {
  const bool in_order = !forecast_ || forecast.stamp >= forecast_->stamp;
  if (!in_order || forecast.stamp > newest_.stamp || std::isnan(forecast.time_to_stop_s)) {
    return;
  }
  const bool kept = forecast.kept_s > 0.0 && forecast.kept_s < kFarthestStop_s;  // neither is NaN
  forecast_ = {forecast.stamp, std::max(0.0, forecast.time_to_stop_s), kept ? forecast.kept_s : 0.0};
  advance();
}

VelocityCommand StopSupervisor::command(const VelocityCommand& in) {
  if (status_.emergency_stop || !in.isFinite()) {
    last_out_ = {};
  } else if (mode_ != StopMode::kActive || !isStopping()) {
    last_out_ = commandWhileDriving(in);
  } else if (status_.state == StopState::kHolding) {
    last_out_ = ramp_.shorten({}, clock_);
  } else {
    last_out_ = ramp_.shorten(in, clock_);
  }
  return last_out_;
}

VelocityCommand StopSupervisor::commandWhileDriving(const VelocityCommand& in) {
  if (status_.overridden) {
    release_ramp_.end();
  }
  return release_ramp_.shorten(in, clock_, params_.deceleration_mps2, params_.angular_deceleration_radps2);
}

std::string StopSupervisor::stopNow() {
  if (isStopping()) {
    return "";
  }
  if (obstacle() != nullptr) {
    return obstacle();
  }
  requestStop("the operator requests a stop");
  advance();
  return "";
}

void StopSupervisor::setOverride(bool overridden) {
  status_.overridden = overridden;
  if (overridden && isStopping()) {
    release("");
  }
  advance();
}

void StopSupervisor::setEmergencyStop(bool stop) {
  if (status_.emergency_stop && !stop) {
    release_ramp_.begin(clock_);
  }
  status_.emergency_stop = stop;
  if (stop && isStopping()) {
    release("");
  }
  advance();
}

void StopSupervisor::restore(const StopLatch& latch) {
  setOverride(latch.overridden);
  setEmergencyStop(latch.emergency_stop);
}

std::optional<double> StopSupervisor::countdown_s() const {
  if (status_.emergency_stop || isStopping()) {
    return 0.0;
  }
  if (mode_ == StopMode::kOff || !has_estimates_) {
    return std::nullopt;
  }
  return std::min(status_.time_left_s, params_.no_stop_due_s);
}

std::optional<double> StopSupervisor::told_mps() const {
  if (status_.emergency_stop) {
    return 0.0;
  }
  return mode_ == StopMode::kActive && isStopping() ? std::optional<double>(last_out_.linear_mps.norm()) : std::nullopt;
}

bool StopSupervisor::hasConverged() const {
  return standstill_.isStanding() && standstill_.zeroUpdates() >= params_.min_zero_updates &&
         newest_.speed_std_mps <= params_.converged_speed_std_mps;
}

/// Goes through the states in order, so that one observation may advance the supervisor by several.
void StopSupervisor::advance() {
  watchForecasts();
  if (!isStopping()) {
    considerStop();
  }
  if (status_.state == StopState::kStopping) {
    considerHold();
  }
  if (status_.state == StopState::kHolding) {
    considerRelease();
  }
}

void StopSupervisor::watchForecasts() {
  const bool holds = forecast_ && forecast_->stamp >= driving_since_;
  const Nanoseconds since = holds ? forecast_->stamp + fromSeconds(forecast_->kept_s) : driving_since_;
  status_.forecasts_stale = has_estimates_ && toSeconds(newest_.stamp - since) > params_.forecast_timeout_s;
}

/// What keeps the supervisor from making any stop, null if nothing does.
const char* StopSupervisor::obstacle() const {
  if (mode_ == StopMode::kOff) {
    return "the supervisor is off";
  }
  if (!has_estimates_) {
    return "no estimates";
  }
  if (status_.emergency_stop) {
    return "emergency stop";
  }
  return status_.overridden ? "overridden by the operator" : nullptr;
}

/// Null if there is a plan.
const char* StopSupervisor::whyNoPlan() const {
  if (obstacle() != nullptr || status_.forecasts_stale) {
    return obstacle();
  }
  if (!forecast_ || forecast_->stamp < driving_since_) {
    return "no forecast since the last stop";
  }
  return forecast_->time_to_stop_s < kFarthestStop_s ? nullptr : "no stop within the forecast horizon";
}

std::optional<StopSupervisor::Plan> StopSupervisor::plan() const {
  if (whyNoPlan() != nullptr) {
    return std::nullopt;
  }
  if (status_.forecasts_stale) {
    return Plan{driving_since_ + fromSeconds(params_.fallback_interval_s), "no new forecast: periodic stop"};
  }
  return Plan{forecast_->stamp + fromSeconds(forecast_->time_to_stop_s), "the position error reaches its threshold"};
}

/// From the present speed to rest; a stop starts this much earlier.
double StopSupervisor::brakingTime_s() const {
  return std::isfinite(newest_.forward_mps) ? std::abs(newest_.forward_mps) / params_.deceleration_mps2 : 0.0;
}

void StopSupervisor::considerStop() {
  if (hasConverged()) {
    driving_since_ = newest_.stamp;
    watchForecasts();
  }
  status_.state = StopState::kDriving;
  status_.time_left_s = kNever_s;
  const std::optional<Plan> next = plan();
  if (!given_up_.empty() && newest_.stamp >= not_before_) {
    given_up_.clear();
  }
  if (!next) {
    status_.reason = given_up_.empty() ? whyNoPlan() : given_up_;
    return;
  }
  const double until_due_s = toSeconds(next->due - newest_.stamp) - brakingTime_s();
  const double until_allowed_s = toSeconds(not_before_ - newest_.stamp);
  status_.time_left_s = std::max({0.0, until_due_s, until_allowed_s});
  status_.reason = given_up_.empty() ? next->reason : given_up_;
  if (status_.time_left_s <= 0.0) {
    requestStop(next->reason);
  } else if (status_.time_left_s <= params_.countdown_s) {
    status_.state = StopState::kCountingDown;
  }
}

void StopSupervisor::requestStop(const char* reason) {
  status_.state = StopState::kStopping;
  status_.time_left_s = 0.0;
  status_.reason = reason;
  requested_ = newest_.stamp;
  holding_since_.reset();
  ramp_.begin(newest_.stamp, last_out_.linear_mps.norm());
}

void StopSupervisor::considerHold() {
  if (standstill_.isStanding()) {
    status_.state = StopState::kHolding;
    status_.reason = "zero updates";
    if (!holding_since_) {
      holding_since_ = newest_.stamp;
      ++status_.stops;
    }
  } else if (standstill_.unacceptedRest_s() >= params_.slide_after_s) {
    giveUp("the rover slides: its wheels are at rest, but it is not");
  } else if (mode_ == StopMode::kActive && toSeconds(clock_ - requested_) >= params_.max_stop_s) {
    giveUp("the rover does not come to rest within " + seconds(params_.max_stop_s));
  }
}

void StopSupervisor::considerRelease() {
  const double held_s = toSeconds(newest_.stamp - *holding_since_);
  status_.time_left_s = std::max(0.0, params_.max_hold_s - held_s);
  if (hasConverged()) {
    release("the velocity has converged after " + seconds(held_s));
  } else if (held_s >= params_.max_hold_s) {
    release("held for " + seconds(held_s));
  } else if (!standstill_.isStanding() && mode_ == StopMode::kAdvise) {
    release("resumed before the velocity had converged");
  } else if (!standstill_.isStanding()) {
    status_.state = StopState::kStopping;
    status_.time_left_s = 0.0;
    status_.reason = "the standstill is no longer accepted";
  }
}

void StopSupervisor::release(const std::string& reason) {
  if (mode_ == StopMode::kActive && clock_ > requested_) {
    release_ramp_.begin(clock_);
  }
  status_.state = StopState::kDriving;
  status_.time_left_s = kNever_s;
  status_.reason = reason;
  given_up_.clear();
  driving_since_ = newest_.stamp;
  not_before_ = newest_.stamp + fromSeconds(params_.min_drive_s);
}

void StopSupervisor::giveUp(const std::string& reason) {
  release(reason);
  ++status_.refusals;
  given_up_ = reason + "; next stop not before " + seconds(params_.retry_after_slide_s);
  not_before_ = newest_.stamp + fromSeconds(std::max(params_.min_drive_s, params_.retry_after_slide_s));
}

}  // namespace slipnav
