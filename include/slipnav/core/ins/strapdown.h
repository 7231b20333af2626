#pragma once
/// Strapdown mechanization in the local navigation frame (Groves 5.4 and 5.5; Savage 1998 for coning and sculling).

#include "slipnav/core/base/types.h"
#include "slipnav/core/earth/planet.h"
#include "slipnav/core/ins/nav_state.h"
#include "slipnav/core/sensors/imu_interval.h"

namespace slipnav {

/// One step of the mechanization. Stateless.
class Strapdown {
 public:
  explicit Strapdown(const Planet& planet) : planet_(planet) {}

  /// State at the end of `current` from the state at its start.
  ///
  /// Second order in the interval: the specific force is resolved along the turning body axes, coning and sculling are
  /// computed from the change between the previous and the current interval (both of any length), gravity, Coriolis and
  /// frame rotation are evaluated at mid-interval. `previous` may have zero duration; then rates count as constant.
  /// @param stamp epoch of the returned state
  NavigationState propagate(const NavigationState& state, const ImuInterval& previous, const ImuInterval& current,
                            Nanoseconds stamp) const;

  const Planet& planet() const { return planet_; }

 private:
  Planet planet_;
};

}  // namespace slipnav
