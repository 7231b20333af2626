#pragma once
/// A forecast of the position error, for whoever decides about stops.

#include <limits>
#include <vector>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// One forecast of the horizontal position error.
struct ErrorOutlook {
  Nanoseconds stamp = 0;                   ///< start of the forecast
  std::vector<double> times_s;             ///< ahead of the stamp, ascending
  std::vector<double> horizontal_bound_m;  ///< bound on the horizontal position error at each of them
  double threshold_m = 0.0;                ///< bound at which the rover is to stop
  /// Until the bound passes the threshold [s], and the distance driven until then [m]; infinite if it does not within
  /// the horizon, zero if it already has.
  double time_to_stop_s = std::numeric_limits<double>::infinity();
  double stop_distance_m = std::numeric_limits<double>::infinity();
  double kept_s = 0.0;  ///< how long the forecast is valid without another one; zero if they are made all the time
};

}  // namespace slipnav
