#include "ros/rviz/operator_view.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ros/runtime/fit_to_drive.h"

namespace slipnav {
namespace {

constexpr double kLifetime_s = 2.0;          // of values that come with every estimate
constexpr double kForecastLifetime_s = 6.0;  // of values that come once a second while driving
constexpr double kStatusLifetime_s = 4.0;    // of diagnostics, which come twice a second
constexpr double kHistory_s = 300.0;
constexpr const char* kInitializer = "initializer";

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

template <class Heard>
bool isFresh(const std::optional<Heard>& heard, double now_s, double lifetime_s) {
  return heard && now_s - heard->time_s <= lifetime_s;
}

/// The nodelet of a status.
std::string nodeletOf(const std::string& status) { return status.substr(status.rfind('/') + 1); }

std::string stateWords(const StopStatus& stop) {
  switch (stop.state) {
    case StopStatus::COUNTING_DOWN:
      return "STOP AHEAD";
    case StopStatus::STOPPING:
      return stop.mode == StopStatus::MODE_ADVISE ? "STOP NOW" : "STOPPING";
    case StopStatus::HOLDING:
      return stop.mode == StopStatus::MODE_ADVISE ? "STAND STILL" : "HOLDING";
    default:
      return "DRIVING";
  }
}

}  // namespace

void OperatorView::take(const StopStatus& message, double now_s) { stop_ = {message, now_s}; }

void OperatorView::take(const ErrorForecast& message, double now_s) {
  forecast_ = {message, now_s};
  if (!message.horizontal_bound_m.empty()) {
    bounds_.emplace_back(now_s, message.horizontal_bound_m.front());
  }
  while (!bounds_.empty() && now_s - bounds_.front().first > kHistory_s) {
    bounds_.pop_front();
  }
}

void OperatorView::take(const Slip& message, double now_s) {
  slip_ = {message, now_s};
  const double way_m = std::abs(message.forward_speed_mps) * message.duration_s;
  since_stop_m_ = message.stationary != 0 ? 0.0 : since_stop_m_ + (std::isfinite(way_m) ? way_m : 0.0);
}

void OperatorView::take(const Initialization& message, double now_s) { start_ = {message, now_s}; }

void OperatorView::take(const std_msgs::String& figures, double now_s) { figures_ = {figures, now_s}; }

void OperatorView::take(const diagnostic_msgs::DiagnosticArray& message, double now_s) {
  for (const diagnostic_msgs::DiagnosticStatus& status : message.status) {
    statuses_[status.name] = {status, now_s};
  }
}

void OperatorView::describe(const StopStatus& stop, OperatorPicture& picture) const {
  picture.emergency_stop = stop.emergency_stop != 0;
  picture.overridden = stop.overridden != 0;
  picture.mode = stop.mode;
  picture.reason = stop.reason;
  picture.state = stateWords(stop);
  picture.mood = stop.state >= StopStatus::STOPPING        ? Mood::kStopping
                 : stop.state == StopStatus::COUNTING_DOWN ? Mood::kAhead
                                                           : Mood::kDriving;
  if (picture.emergency_stop) {
    picture.state = "EMERGENCY STOP";
    picture.mood = Mood::kDanger;
  } else if (picture.overridden) {
    picture.state = "OVERRIDE";
    picture.mood = Mood::kAhead;
  } else if (std::isfinite(stop.time_left_s) && stop.state != StopStatus::STOPPING) {
    const char* format = stop.state == StopStatus::HOLDING ? "at most %.0f s more" : "stop in %.0f s";
    picture.countdown = formatted(format, stop.time_left_s);
  }
}

void OperatorView::addForecast(double now_s, OperatorPicture& picture) const {
  for (const auto& [time_s, bound_m] : bounds_) {
    picture.history.emplace_back(now_s - time_s, bound_m);
  }
  if (!picture.isStale() && isFresh(forecast_, now_s, kForecastLifetime_s) &&
      !forecast_->message.horizontal_bound_m.empty()) {
    picture.bound_m = forecast_->message.horizontal_bound_m.front();
  }
  picture.threshold_m = forecast_ ? forecast_->message.threshold_m : 0.0;
}

void OperatorView::addAlarms(double now_s, OperatorPicture& picture) const {
  for (const auto& [name, heard] : statuses_) {
    const std::string who = nodeletOf(name);
    if (who == kFitToDrive) {
      continue;  // repeats the same
    }
    if (now_s - heard.time_s > kStatusLifetime_s) {
      picture.alarms.push_back({diagnostic_msgs::DiagnosticStatus::STALE, who + ": has stopped reporting"});
    } else if (heard.message.level != diagnostic_msgs::DiagnosticStatus::OK) {
      picture.alarms.push_back({heard.message.level, who + ": " + heard.message.message});
    }
  }
  std::stable_sort(picture.alarms.begin(), picture.alarms.end(), [](const OperatorAlarm& a, const OperatorAlarm& b) {
    return severityOf(a.level) > severityOf(b.level);
  });
}

bool OperatorView::isStarting(double now_s) const {
  const bool has_ended = std::any_of(statuses_.begin(), statuses_.end(), [now_s](const auto& status) {
    return nodeletOf(status.first) == kInitializer && now_s - status.second.time_s > kStatusLifetime_s;
  });
  return start_ && start_->message.done == 0 && !has_ended;
}

OperatorPicture OperatorView::picture(double now_s) const {
  OperatorPicture picture;
  if (isFresh(stop_, now_s, kLifetime_s)) {
    describe(stop_->message, picture);
  }
  if (isStarting(now_s) && !picture.emergency_stop) {
    picture.state = "START";
    picture.mood = Mood::kStart;
    picture.countdown.clear();
    picture.reason = start_->message.progress;
  } else if (picture.isStale()) {
    picture.state = "NO DATA";
    picture.reason = stop_ ? "nothing received from the stop supervisor lately" : "waiting for the stop supervisor";
  }
  if (isFresh(slip_, now_s, kLifetime_s)) {
    const double slip = slip_->message.mean_ratio;
    picture.slip = std::isfinite(slip) ? formatted("%.0f %%", 100.0 * slip) : "–";
    picture.since_stop = formatted("%.1f m", since_stop_m_);
  }
  if (isFresh(figures_, now_s, kLifetime_s)) {
    picture.figures = figures_->message.data;
  }
  addForecast(now_s, picture);
  addAlarms(now_s, picture);
  return picture;
}

}  // namespace slipnav
