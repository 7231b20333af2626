#include "slipnav/core/earth/local_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulation/random.h"

namespace slipnav {
namespace {

Geodetic randomPlace(sim::RandomStream& random, const Geodetic& about) {
  return {about.latitude_rad + 1e-3 * random.normal(), about.longitude_rad + 1e-3 * random.normal(),
          about.height_m + 100.0 * random.normal()};
}

TEST(LocalFrame, OriginIsZeroAndAxesPointEastNorthUp) {
  const Planet earth = Planet::byName("earth");
  const Geodetic origin{degToRad(40.0), degToRad(-80.0), 250.0};
  const LocalFrame frame(earth, origin);
  EXPECT_NEAR(frame.toEnu(origin).norm(), 0.0, 1e-8);
  const double step_rad = 1e-6;
  const double north_m = earth.meridianRadius(origin.latitude_rad) + origin.height_m;
  const double east_m = (earth.transverseRadius(origin.latitude_rad) + origin.height_m) * std::cos(origin.latitude_rad);
  const Vector3 east = frame.toEnu({origin.latitude_rad, origin.longitude_rad + step_rad, origin.height_m});
  const Vector3 north = frame.toEnu({origin.latitude_rad + step_rad, origin.longitude_rad, origin.height_m});
  const Vector3 up = frame.toEnu({origin.latitude_rad, origin.longitude_rad, origin.height_m + 1.0});
  EXPECT_NEAR((east - Vector3(step_rad * east_m, 0.0, 0.0)).norm(), 0.0, 1e-5);
  EXPECT_NEAR((north - Vector3(0.0, step_rad * north_m, 0.0)).norm(), 0.0, 1e-5);
  EXPECT_NEAR((up - Vector3(0.0, 0.0, 1.0)).norm(), 0.0, 1e-8);
}

TEST(LocalFrame, RoundTripOnEveryPlanet) {
  sim::RandomStream random(1, "places");
  for (const char* name : {"earth", "mars", "moon"}) {
    const Geodetic origin{degToRad(-35.0), degToRad(120.0), -1500.0};
    const LocalFrame frame(Planet::byName(name), origin);
    for (int i = 0; i < 20; ++i) {
      const Vector3 enu = 2000.0 * random.normal3();
      EXPECT_NEAR((frame.toEnu(frame.toGeodetic(enu)) - enu).norm(), 0.0, 1e-6) << name;
    }
  }
}

/// The columns of C_n_to_enu are the derivatives of the coordinates along north, east and down.
TEST(LocalFrame, AttitudeOfLocalAxesIsTheDerivativeOfPositions) {
  const Planet earth = Planet::byName("earth");
  const Geodetic origin{degToRad(60.0), degToRad(10.0), 100.0};
  const LocalFrame frame(earth, origin);
  sim::RandomStream random(2, "places");
  for (int i = 0; i < 10; ++i) {
    const Geodetic p = randomPlace(random, origin);
    const double north_m = earth.meridianRadius(p.latitude_rad) + p.height_m;
    const double east_m = (earth.transverseRadius(p.latitude_rad) + p.height_m) * std::cos(p.latitude_rad);
    const double h = 1e-6;
    Matrix3 axes;
    axes.col(0) = (frame.toEnu({p.latitude_rad + h, p.longitude_rad, p.height_m}) -
                   frame.toEnu({p.latitude_rad - h, p.longitude_rad, p.height_m})) /
                  (2.0 * h * north_m);
    axes.col(1) = (frame.toEnu({p.latitude_rad, p.longitude_rad + h, p.height_m}) -
                   frame.toEnu({p.latitude_rad, p.longitude_rad - h, p.height_m})) /
                  (2.0 * h * east_m);
    axes.col(2) = (frame.toEnu({p.latitude_rad, p.longitude_rad, p.height_m - 1.0}) -
                   frame.toEnu({p.latitude_rad, p.longitude_rad, p.height_m + 1.0})) /
                  2.0;
    const Matrix3 C_n_to_enu = frame.C_n_to_enu(p);
    EXPECT_LT((C_n_to_enu - axes).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_LT((C_n_to_enu * C_n_to_enu.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_NEAR(C_n_to_enu.determinant(), 1.0, 1e-13);
  }
}

}  // namespace
}  // namespace slipnav
