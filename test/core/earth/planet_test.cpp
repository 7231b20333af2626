#include "slipnav/core/earth/planet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "core/base/square.h"
#include "slipnav/core/earth/local_frame.h"

namespace slipnav {
namespace {

double gravityAt(const Planet& planet, double latitude_deg, double height_m) {
  return planet.gravity_n({degToRad(latitude_deg), 0.0, height_m}).z();
}

/// Position from the planet's center, by the textbook formula (Groves 2.112).
Vector3 cartesian(const Planet& planet, const Geodetic& place) {
  const double f = planet.flattening();
  const double normal_m = planet.transverseRadius(place.latitude_rad);
  const double around_m = (normal_m + place.height_m) * std::cos(place.latitude_rad);
  return {around_m * std::cos(place.longitude_rad), around_m * std::sin(place.longitude_rad),
          ((1.0 - f) * (1.0 - f) * normal_m + place.height_m) * std::sin(place.latitude_rad)};
}

TEST(Planet, EarthHasTheRadiiOfWgs84) {
  const Planet earth = Planet::byName("earth");
  EXPECT_DOUBLE_EQ(earth.equatorialRadius(), 6378137.0);
  EXPECT_NEAR(1.0 / earth.flattening(), 298.257223563, 1e-9);
  EXPECT_NEAR(earth.rotationRate(), 7.292115e-5, 1e-12);
  // NIMA TR8350.2: polar radius of curvature a²/b, meridian radius at the equator b²/a
  EXPECT_NEAR(earth.meridianRadius(0.5 * kPi), 6399593.6258, 1e-3);
  EXPECT_NEAR(earth.transverseRadius(0.5 * kPi), 6399593.6258, 1e-3);
  EXPECT_NEAR(earth.meridianRadius(0.0), 6335439.3273, 1e-3);
  EXPECT_NEAR(earth.transverseRadius(0.0), 6378137.0, 1e-6);
}

TEST(Planet, RadiiAreThoseOfTheSurface) {
  for (const char* name : {"earth", "mars", "moon"}) {
    const Planet planet = Planet::byName(name);
    for (const double latitude_deg : {-75.0, -20.0, 0.0, 39.7, 60.0}) {
      const Geodetic place{degToRad(latitude_deg), 0.3, 800.0};
      const double h = 1e-5;
      const Vector3 by_latitude = (cartesian(planet, {place.latitude_rad + h, place.longitude_rad, place.height_m}) -
                                   cartesian(planet, {place.latitude_rad - h, place.longitude_rad, place.height_m})) /
                                  (2.0 * h);
      EXPECT_NEAR(by_latitude.norm(), planet.meridianRadius(place.latitude_rad) + place.height_m, 0.01) << name;
    }
  }
}

TEST(Planet, EarthHasTheGravityOfWgs84) {
  const Planet earth = Planet::byName("earth");
  EXPECT_NEAR(gravityAt(earth, 0.0, 0.0), 9.7803253359, 1e-9);
  EXPECT_NEAR(gravityAt(earth, 90.0, 0.0), 9.8321849378, 1e-9);
  EXPECT_NEAR(gravityAt(earth, -90.0, 0.0), 9.8321849378, 1e-9);
  // Somigliana's closed form (Groves 2.134)
  const double s2 = std::pow(std::sin(degToRad(45.0)), 2);
  EXPECT_NEAR(gravityAt(earth, 45.0, 0.0),
              9.7803253359 * (1.0 + 0.001931853 * s2) / std::sqrt(1.0 - 0.0818191908425 * 0.0818191908425 * s2), 1e-8);
}

TEST(Planet, GravityFallsWithHeight) {
  const Planet earth = Planet::byName("earth");
  // Groves (2.139) at 45° and 1000 m: second-order free-air reduction
  const double a = earth.equatorialRadius();
  const double f = earth.flattening();
  const double m = std::pow(earth.rotationRate() * a, 2) * a * (1.0 - f) / 3.986004418e14;
  const double factor = 1.0 - 2.0 / a * (1.0 + f + m - f) * 1000.0 + 3.0e6 / (a * a);
  EXPECT_NEAR(gravityAt(earth, 45.0, 1000.0), factor * gravityAt(earth, 45.0, 0.0), 2e-7);
  // north component off the surface: −8.08e-9 h sin 2L m/s² (Groves 2.140)
  const Vector3 g = earth.gravity_n({degToRad(45.0), 0.0, 1000.0});
  EXPECT_NEAR(g.x(), -8.08e-6, 2e-7);
  EXPECT_EQ(g.y(), 0.0);
}

TEST(Planet, GravityOfMarsAndMoon) {
  const Planet mars = Planet::byName("mars");
  EXPECT_NEAR(gravityAt(mars, 0.0, 0.0), 3.71, 0.01);  // IAU/NASA fact sheet: 3.71 m/s² at the equator
  EXPECT_NEAR(gravityAt(mars, 90.0, 0.0), 3.73, 0.02);
  EXPECT_NEAR(2.0 * kPi / mars.rotationRate(), 88642.66, 0.5);  // sidereal day of 24 h 37 min 22.66 s
  const Planet moon = Planet::byName("moon");
  EXPECT_NEAR(gravityAt(moon, 30.0, 0.0), 1.624, 0.002);
  EXPECT_NEAR(2.0 * kPi / moon.rotationRate() / 86400.0, 27.3217, 0.0005);  // sidereal month
}

TEST(Planet, UnknownNameIsRefusedByName) {
  try {
    Planet::byName("pluto");
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("pluto"), std::string::npos);
  }
}

TEST(Planet, RotationPointsToThePole) {
  const Planet earth = Planet::byName("earth");
  const double rate = earth.rotationRate();
  EXPECT_NEAR((earth.omega_ie_n(0.0) - Vector3(rate, 0.0, 0.0)).norm(), 0.0, 1e-18);
  EXPECT_NEAR((earth.omega_ie_n(0.5 * kPi) - Vector3(0.0, 0.0, -rate)).norm(), 0.0, 1e-18);
  EXPECT_NEAR((earth.omega_ie_n(-0.5 * kPi) - Vector3(0.0, 0.0, rate)).norm(), 0.0, 1e-18);
  EXPECT_NEAR(earth.omega_ie_n(degToRad(50.0)).norm(), rate, 1e-18);
}

/// C_n_to_e' = C_n_to_e [ω_en_n ×], with the attitude of the local axes from the tangent plane.
TEST(Planet, TransportRateTurnsTheLocalAxes) {
  const Planet earth = Planet::byName("earth");
  const Geodetic place{degToRad(48.0), degToRad(11.0), 500.0};
  const LocalFrame frame(earth, place);
  const double north_m = earth.meridianRadius(place.latitude_rad) + place.height_m;
  const double east_m = (earth.transverseRadius(place.latitude_rad) + place.height_m) * std::cos(place.latitude_rad);
  for (const Vector3& v : {Vector3(100.0, 0.0, 0.0), Vector3(0.0, 100.0, 0.0), Vector3(-30.0, 70.0, 5.0)}) {
    const double dt_s = 5.0;
    const auto attitudeAt = [&](double t) {
      return frame.C_n_to_enu({place.latitude_rad + t * v.x() / north_m, place.longitude_rad + t * v.y() / east_m,
                               place.height_m - t * v.z()});
    };
    const Matrix3 turning = attitudeAt(0.0).transpose() * (attitudeAt(dt_s) - attitudeAt(-dt_s)) / (2.0 * dt_s);
    const Vector3 omega(turning(2, 1), turning(0, 2), turning(1, 0));
    EXPECT_NEAR((earth.omega_en_n(place, v) - omega).norm(), 0.0, 1e-11) << v.transpose();
    EXPECT_GT(omega.norm(), 1e-6);
  }
}

/// Of the IAU: the ellipsoid of Mars, the sphere of the Moon.
TEST(Planet, MarsAndMoonHaveTheirFigures) {
  const Planet mars = Planet::byName("mars");
  EXPECT_EQ(mars.equatorialRadius(), 3396190.0);
  EXPECT_NEAR(1.0 / mars.flattening(), 169.89444722, 1e-8);
  EXPECT_NEAR(gravityAt(mars, 0.0, 0.0), 4.282837e13 / square(3396190.0), 0.03) << "less what the rotation takes";
  const Planet moon = Planet::byName("moon");
  EXPECT_EQ(moon.equatorialRadius(), 1737400.0);
  EXPECT_EQ(moon.flattening(), 0.0);
  EXPECT_NEAR(gravityAt(moon, 90.0, 0.0), 4.9028e12 / square(1737400.0), 1e-4);
}

}  // namespace
}  // namespace slipnav
