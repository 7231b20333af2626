#include "evaluation/truth_lag.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slipnav {
namespace {

constexpr double kDuration_s = 120.0;

/// Bends, and a stop in the middle.
Vector2 placeAt(double time_s) {
  const double driven_s = time_s < 50.0 ? time_s : time_s < 60.0 ? 50.0 : time_s - 10.0;
  return {0.5 * driven_s, 6.0 * std::sin(0.05 * driven_s)};
}

PlanarTrack drive() {
  PlanarTrack track;
  for (double t_s = 0.0; t_s < kDuration_s; t_s += 0.2) {
    track.push_back({fromSeconds(t_s), placeAt(t_s).x(), placeAt(t_s).y(), 0.0});
  }
  return track;
}

/// In another frame, of another scale, and stamped late.
TruthTrack truth(double late_s) {
  std::vector<TruthSample> samples;
  for (double t_s = 0.0; t_s < kDuration_s; t_s += 0.5) {
    const Vector2 place_m = Eigen::Rotation2Dd(1.1) * (1.04 * placeAt(t_s)) + Vector2(30.0, -7.0);
    TruthSample sample;
    sample.stamp = fromSeconds(t_s + late_s);
    sample.position_enu_m << place_m, 2.0;
    samples.push_back(sample);
  }
  return TruthTrack(std::move(samples));
}

TEST(TruthLagTest, findsTheLagToATenthOfASecond) {
  for (const double late_s : {-18.0, -1.2, 3.7, 18.0}) {
    const std::optional<TruthLag> lag = truthLag(drive(), truth(late_s));
    ASSERT_TRUE(lag) << late_s;
    EXPECT_NEAR(lag->late_s, late_s, 0.06);
    EXPECT_LT(lag->apart_m, 0.2 * lag->rms_m);
  }
}

TEST(TruthLagTest, saysNothingOfATruthThatFits) {
  EXPECT_FALSE(truthLag(drive(), truth(0.0)));
  EXPECT_FALSE(truthLag(drive(), truth(0.1)));  // a receiver's delay
  EXPECT_FALSE(truthLag(drive(), TruthTrack()));
}

TEST(TruthLagTest, saysNothingOfAStraightLine) {
  PlanarTrack straight;
  std::vector<TruthSample> samples;
  for (double t_s = 0.0; t_s < kDuration_s; t_s += 0.5) {
    straight.push_back({fromSeconds(t_s), 0.5 * t_s, 0.0, 0.0});
    samples.push_back({fromSeconds(t_s + 18.0), Vector3(0.5 * t_s + 0.3 * std::sin(7.0 * t_s), 0.0, 0.0)});
  }
  EXPECT_FALSE(truthLag(straight, TruthTrack(samples)));
}

TEST(TruthLagTest, namesGpsTime) {
  EXPECT_NE(describe({18.0, 5.0, 0.1}).find("18.0 s too late relative to the drive (18 s: GPS time"),
            std::string::npos);
  EXPECT_EQ(describe({-3.0, 5.0, 0.1}).find("GPS"), std::string::npos);
}

}  // namespace
}  // namespace slipnav
