#pragma once
/// What a forecast of the position error says to whoever decides about stops.

#include <limits>
#include <vector>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// One forecast of the horizontal position error.
struct ErrorOutlook {
  Nanoseconds stamp = 0;                   ///< when the forecast begins
  std::vector<double> times_s;             ///< ahead of the stamp, ascending
  std::vector<double> horizontal_bound_m;  ///< bound of the horizontal position error at each of them
  double threshold_m = 0.0;                ///< bound at which the rover shall stop
  /// Until the bound passes the threshold [s], and the way driven until then [m]; infinite when it does not within the
  /// horizon, zero when it is there already.
  double time_to_stop_s = std::numeric_limits<double>::infinity();
  double stop_distance_m = std::numeric_limits<double>::infinity();
  double kept_s = 0.0;  ///< so long the forecast holds without another one; zero where they are made all the time
};

}  // namespace slipnav
