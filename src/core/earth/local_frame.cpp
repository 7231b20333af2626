#include "slipnav/core/earth/local_frame.h"

#include <vector>

namespace slipnav {
namespace {

GeographicLib::LocalCartesian planeAt(const GeographicLib::Geocentric& ellipsoid, const Geodetic& origin) {
  return {radToDeg(origin.latitude_rad), radToDeg(origin.longitude_rad), origin.height_m, ellipsoid};
}

}  // namespace

LocalFrame::LocalFrame(const Planet& planet, const Geodetic& origin)
    : origin_(origin),
      ellipsoid_(planet.equatorialRadius(), planet.flattening()),
      plane_(planeAt(ellipsoid_, origin)) {}

Vector3 LocalFrame::toEnu(const Geodetic& position) const {
  Vector3 enu;
  plane_.Forward(radToDeg(position.latitude_rad), radToDeg(position.longitude_rad), position.height_m, enu.x(), enu.y(),
                 enu.z());
  return enu;
}

Geodetic LocalFrame::toGeodetic(const Vector3& position_enu_m) const {
  Vector3 geodetic;  // latitude and longitude [°], height [m]
  plane_.Reverse(position_enu_m.x(), position_enu_m.y(), position_enu_m.z(), geodetic.x(), geodetic.y(), geodetic.z());
  return {degToRad(geodetic.x()), degToRad(geodetic.y()), geodetic.z()};
}

Matrix3 LocalFrame::C_n_to_enu(const Geodetic& position) const {
  static thread_local std::vector<double> m(9);
  Vector3 enu;
  plane_.Forward(radToDeg(position.latitude_rad), radToDeg(position.longitude_rad), position.height_m, enu.x(), enu.y(),
                 enu.z(), m);
  // GeographicLib's matrix takes local east-north-up at the position to this plane's axes
  Matrix3 C_enu_to_enu0;
  C_enu_to_enu0 << m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8];
  Matrix3 C_ned_to_enu;
  C_ned_to_enu << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  return C_enu_to_enu0 * C_ned_to_enu;
}

}  // namespace slipnav
