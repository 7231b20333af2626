#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulation/ground.h"
#include "simulation/random.h"
#include "simulation/terrain.h"

namespace slipnav::sim {
namespace {

constexpr double kStraight_m = 12.0;

Terrain terrainOf(const std::string& name, std::uint64_t seed) {
  return {groundByName(name).relief, 0.7, kStraight_m, seed};
}

Vector2 onStraight(double distance_m) { return distance_m * Vector2(std::sin(0.7), std::cos(0.7)); }

TEST(SimTerrain, DerivativesMatchDifferencesFromTheStartOutwards) {
  const Terrain terrain = terrainOf("rough", 4);
  const double h = 1e-4;
  RandomStream stream(1, "places");
  for (int i = 0; i < 200; ++i) {
    const Vector2 place(stream.uniform(-60.0, 60.0), stream.uniform(-60.0, 60.0));
    const SurfacePoint point = terrain.at(place);
    for (int axis = 0; axis < 2; ++axis) {
      const Vector2 step = h * Vector2::Unit(axis);
      const SurfacePoint ahead = terrain.at(place + step);
      const SurfacePoint behind = terrain.at(place - step);
      EXPECT_NEAR(point.gradient[axis], (ahead.height_m - behind.height_m) / (2.0 * h), 1e-7);
      const Vector2 curvature = (ahead.gradient - behind.gradient) / (2.0 * h);
      EXPECT_LT((point.hessian_per_m.col(axis) - curvature).norm(), 1e-6);
    }
  }
}

TEST(SimTerrain, FollowerAgreesToRounding) {
  const Terrain terrain = terrainOf("rough", 5);
  TerrainFollower follower(terrain);
  for (int i = 0; i < 20000; ++i) {
    const Vector2 place(0.003 * i, 0.002 * i);
    const SurfacePoint exact = terrain.at(place);
    const SurfacePoint quick = follower.at(place);
    ASSERT_NEAR(quick.height_m, exact.height_m, 1e-13);
    ASSERT_LT((quick.gradient - exact.gradient).norm(), 1e-13);
    ASSERT_LT((quick.hessian_per_m - exact.hessian_per_m).norm(), 1e-12);
  }
}

TEST(SimTerrain, StartsAtHeightZeroOnNearlyLevelFirmGround) {
  for (const char* name : kTerrainNames) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const Terrain terrain = terrainOf(name, seed);
      EXPECT_EQ(terrain.at(Vector2::Zero()).height_m, 0.0);
      for (double distance_m = 0.0; distance_m <= kStraight_m; distance_m += 0.5) {
        const SurfacePoint point = terrain.at(onStraight(distance_m));
        EXPECT_LT(point.gradient.norm(), std::tan(degToRad(1.5))) << name << " " << seed;
        EXPECT_LT(point.looseness, 0.01);
      }
      EXPECT_GT(terrain.at(onStraight(50.0)).looseness, 0.99);
    }
  }
}

/// Root mean square slope along a straight track far from the start, over seeds [deg].
double trackSlope(const std::string& name, double& steepest_deg) {
  double sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Terrain terrain = terrainOf(name, seed);
    for (double east_m = 100.0; east_m < 700.0; east_m += 0.3) {
      const Vector2 gradient = terrain.at({east_m, 200.0}).gradient;
      steepest_deg = std::max(steepest_deg, radToDeg(std::atan(gradient.norm())));
      sum += gradient.x() * gradient.x();
      ++count;
    }
  }
  return radToDeg(std::sqrt(sum / count));
}

TEST(SimTerrain, SlopesGrowFromPavedToRough) {
  double steepest_deg = 0.0;
  const double paved = trackSlope("paved", steepest_deg);
  EXPECT_LT(steepest_deg, 3.0);
  const double unpaved = trackSlope("unpaved", steepest_deg);
  const double gravel = trackSlope("gravel", steepest_deg);
  steepest_deg = 0.0;
  const double rough = trackSlope("rough", steepest_deg);
  EXPECT_LT(2.0 * paved, unpaved);
  EXPECT_LT(unpaved, gravel);
  EXPECT_LT(1.5 * gravel, rough);
  EXPECT_NEAR(rough, 4.8, 0.8);  // slope and footprint-smoothed roughness together
  EXPECT_GT(steepest_deg, 12.0);
  EXPECT_LT(steepest_deg, 25.0);
}

TEST(SimGround, UnknownTerrainIsNamed) {
  try {
    groundByName("lava");
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("'lava'"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("gravel"), std::string::npos);
  }
}

}  // namespace
}  // namespace slipnav::sim
