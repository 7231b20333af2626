#pragma once
/// The stops of a drive as they happen: where, how long, and the change of the error.

#include <cstddef>
#include <deque>
#include <optional>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Horizontal error at one moment, by truth if there is one, and by the bound of the estimate.
struct ErrorReading {
  std::optional<double> true_m;
  double bound_m = 0.0;  ///< 3σ
};

/// One stop and what it did to the error.
struct LoggedStop {
  int number = 0;  ///< counts from 1
  Nanoseconds begin = 0;
  double duration_s = 0.0;
  Vector3 position_enu_m = Vector3::Zero();
  ErrorReading before;  ///< the last one in motion
  ErrorReading after;   ///< the last one at standstill
};

/// Detects stops from the standstill flag of the estimates.
class StopLog {
 public:
  /// @param capacity beyond it the oldest stops are dropped
  explicit StopLog(std::size_t capacity) : capacity_(capacity) {}

  void clear();

  /// One epoch, in ascending order of stamp. Standing before the first motion does not count, nor does a short rest.
  void add(Nanoseconds stamp, bool stationary, const Vector3& position_enu_m, const ErrorReading& error);

  /// The newest is last; it may still be in progress.
  const std::deque<LoggedStop>& stops() const { return stops_; }

 private:
  void begin(Nanoseconds stamp, const Vector3& position_enu_m, const ErrorReading& error);

  std::size_t capacity_;
  bool has_moved_ = false;
  std::optional<LoggedStop> open_;  ///< too short so far to count
  bool standing_ = false;
  int count_ = 0;
  ErrorReading moving_error_;
  std::deque<LoggedStop> stops_;
};

}  // namespace slipnav
