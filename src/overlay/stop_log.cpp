#include "overlay/stop_log.h"

namespace slipnav {
namespace {

/// Shorter standstill is not a stop; as in findStops().
constexpr double kShortestStop_s = 0.5;

}  // namespace

void StopLog::clear() { *this = StopLog(capacity_); }

void StopLog::begin(Nanoseconds stamp, const Vector3& position_enu_m, const ErrorReading& error) {
  open_.emplace();
  open_->begin = stamp;
  open_->position_enu_m = position_enu_m;
  open_->before = moving_error_;
  open_->after = error;
}

void StopLog::add(Nanoseconds stamp, bool stationary, const Vector3& position_enu_m, const ErrorReading& error) {
  if (!stationary) {
    has_moved_ = true;
    standing_ = false;
    open_.reset();
    moving_error_ = error;
    return;
  }
  if (!has_moved_) {
    return;
  }
  if (!standing_) {
    standing_ = true;
    begin(stamp, position_enu_m, error);
  }
  LoggedStop& stop = open_ ? *open_ : stops_.back();
  stop.duration_s = toSeconds(stamp - stop.begin);
  stop.position_enu_m = position_enu_m;
  stop.after = error;
  if (open_ && open_->duration_s >= kShortestStop_s && capacity_ > 0) {
    open_->number = ++count_;
    stops_.push_back(*open_);
    open_.reset();
    if (stops_.size() > capacity_) {
      stops_.pop_front();
    }
  }
}

}  // namespace slipnav
