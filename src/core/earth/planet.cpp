#include "slipnav/core/earth/planet.h"

#include <GeographicLib/Constants.hpp>
#include <stdexcept>
#include <utility>

namespace slipnav {

Planet Planet::byName(const std::string& name) {
  if (name == "earth") {
    using GeographicLib::Constants;
    return {name, Constants::WGS84_a(), Constants::WGS84_GM(), Constants::WGS84_omega(), Constants::WGS84_f()};
  }
  if (name == "mars") {  // IAU 2000 ellipsoid and rotation, GM of the MRO120D field
    return {name, 3396190.0, 4.282837e13, 7.088218e-5, 1.0 / 169.89444722361179};
  }
  if (name == "moon") {  // IAU 2015 sphere: selenographic coordinates are spherical
    return {name, 1737400.0, 4.9028e12, 2.6616995e-6, 0.0};
  }
  throw std::invalid_argument("planet '" + name + "' is not known (earth, mars, moon)");
}

Planet::Planet(std::string name, double equatorial_radius_m, double gm_m3_per_s2, double rotation_rate_radps,
               double flattening)
    : name_(std::move(name)),
      a_m_(equatorial_radius_m),
      f_(flattening),
      e2_(flattening * (2.0 - flattening)),
      omega_ie_radps_(rotation_rate_radps),
      field_(equatorial_radius_m, gm_m3_per_s2, rotation_rate_radps, flattening, true) {}

double Planet::meridianRadius(double latitude_rad) const {
  const double s = std::sin(latitude_rad);
  const double w2 = 1.0 - e2_ * s * s;
  return a_m_ * (1.0 - e2_) / (w2 * std::sqrt(w2));
}

double Planet::transverseRadius(double latitude_rad) const {
  const double s = std::sin(latitude_rad);
  return a_m_ / std::sqrt(1.0 - e2_ * s * s);
}

Vector3 Planet::gravity_n(const Geodetic& position) const {
  double north = 0.0;
  double up = 0.0;
  field_.Gravity(radToDeg(position.latitude_rad), position.height_m, north, up);
  return {north, 0.0, -up};
}

Vector3 Planet::omega_ie_n(double latitude_rad) const {
  return {omega_ie_radps_ * std::cos(latitude_rad), 0.0, -omega_ie_radps_ * std::sin(latitude_rad)};
}

Vector3 Planet::omega_en_n(const Geodetic& position, const Vector3& v_eb_n) const {
  const double north_m = meridianRadius(position.latitude_rad) + position.height_m;
  const double east_m = transverseRadius(position.latitude_rad) + position.height_m;
  return {v_eb_n.y() / east_m, -v_eb_n.x() / north_m, -v_eb_n.y() * std::tan(position.latitude_rad) / east_m};
}

}  // namespace slipnav
