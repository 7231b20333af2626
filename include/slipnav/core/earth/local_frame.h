#pragma once
/// Local tangent plane (east-north-up) about a fixed origin, by GeographicLib's LocalCartesian.

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>

#include "slipnav/core/base/types.h"
#include "slipnav/core/earth/planet.h"

namespace slipnav {

/// The map frame of one start. Immutable.
class LocalFrame {
 public:
  LocalFrame(const Planet& planet, const Geodetic& origin);

  const Geodetic& origin() const { return origin_; }

  /// East, north, up coordinates [m] of a geodetic position.
  Vector3 toEnu(const Geodetic& position) const;
  /// Inverse of toEnu().
  Geodetic toGeodetic(const Vector3& position_enu_m) const;
  /// Rotation that takes a vector from the north-east-down axes *at the position* to this frame's east-north-up.
  Matrix3 C_n_to_enu(const Geodetic& position) const;

 private:
  Geodetic origin_;
  GeographicLib::Geocentric ellipsoid_;
  GeographicLib::LocalCartesian plane_;
};

}  // namespace slipnav
