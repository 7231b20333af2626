#pragma once
/// Ellipsoid, gravity and rotation of the planet (Groves 2.4), by GeographicLib's NormalGravity.

#include <GeographicLib/NormalGravity.hpp>
#include <string>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Position on or near the ellipsoid.
struct Geodetic {
  double latitude_rad = 0.0;
  double longitude_rad = 0.0;
  double height_m = 0.0;
};

/// Functions of latitude and height on one planet. Immutable; latitudes are geodetic [rad].
class Planet {
 public:
  /// @param name "earth" (WGS84), "mars" or "moon". Throws std::invalid_argument that names anything else.
  static Planet byName(const std::string& name);

  /// Any other planet. @param gm_m3_per_s2 gravitational constant times mass; @param rotation_rate_radps sidereal
  Planet(std::string name, double equatorial_radius_m, double gm_m3_per_s2, double rotation_rate_radps,
         double flattening);

  const std::string& name() const { return name_; }
  double equatorialRadius() const { return a_m_; }  ///< [m]
  double flattening() const { return f_; }
  double rotationRate() const { return omega_ie_radps_; }  ///< [rad/s]

  /// Meridian radius of curvature R_N(L) [m], Groves (2.105).
  double meridianRadius(double latitude_rad) const;
  /// Transverse radius of curvature R_E(L) [m], Groves (2.106).
  double transverseRadius(double latitude_rad) const;
  /// Normal gravity (gravitation and centrifugal) in north-east-down axes at the position [m/s²].
  Vector3 gravity_n(const Geodetic& position) const;
  /// Planet rotation w.r.t. inertial space in north-east-down axes [rad/s], Groves (2.123).
  Vector3 omega_ie_n(double latitude_rad) const;
  /// Rotation of the local north-east-down frame over the ellipsoid [rad/s], Groves (5.44).
  /// Undefined at the poles, where north is undefined.
  Vector3 omega_en_n(const Geodetic& position, const Vector3& v_eb_n) const;

 private:
  std::string name_;
  double a_m_;
  double f_;
  double e2_;
  double omega_ie_radps_;
  GeographicLib::NormalGravity field_;
};

}  // namespace slipnav
