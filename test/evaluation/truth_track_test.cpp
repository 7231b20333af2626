#include "evaluation/truth_track.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "evaluation/estimate.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/earth/planet.h"

namespace slipnav {
namespace {

TruthSample sampleAt(double t_s, const Vector3& position_enu_m) {
  TruthSample sample;
  sample.stamp = fromSeconds(t_s);
  sample.position_enu_m = position_enu_m;
  return sample;
}

TEST(TruthTrack, interpolatesLinearlyBetweenNeighbors) {
  const TruthTrack track({sampleAt(10.0, {0.0, 2.0, 4.0}), sampleAt(11.0, {1.0, 0.0, 8.0})});
  const auto sample = track.at(fromSeconds(10.25));
  ASSERT_TRUE(sample.has_value());
  EXPECT_EQ(sample->stamp, fromSeconds(10.25));
  EXPECT_LT((sample->position_enu_m - Vector3(0.25, 1.5, 5.0)).norm(), 1e-12);
}

TEST(TruthTrack, answersAtItsEndsButNotBeyond) {
  const TruthTrack track({sampleAt(1.0, Vector3::Zero()), sampleAt(2.0, Vector3::Ones())});
  EXPECT_TRUE(track.at(fromSeconds(1.0)).has_value());
  ASSERT_TRUE(track.at(fromSeconds(2.0)).has_value());
  EXPECT_EQ(track.at(fromSeconds(2.0))->position_enu_m, Vector3::Ones());
  EXPECT_FALSE(track.at(fromSeconds(1.0) - 1).has_value());
  EXPECT_FALSE(track.at(fromSeconds(2.0) + 1).has_value());
  EXPECT_FALSE(TruthTrack().at(0).has_value());
}

TEST(TruthTrack, doesNotBridgeLongGaps) {
  const std::vector<TruthSample> samples = {sampleAt(0.0, Vector3::Zero()), sampleAt(1.6, Vector3::Ones())};
  EXPECT_FALSE(TruthTrack(samples).at(fromSeconds(0.8)).has_value());
  EXPECT_TRUE(TruthTrack(samples).at(fromSeconds(1.6)).has_value());
  EXPECT_TRUE(TruthTrack(samples, 1.6).at(fromSeconds(0.8)).has_value());
}

TEST(TruthTrack, sortsAndDropsRepeatedStamps) {
  const TruthTrack track(
      {sampleAt(2.0, {2, 0, 0}), sampleAt(1.0, {1, 0, 0}), sampleAt(2.0, {9, 0, 0}), sampleAt(0.0, {0, 0, 0})});
  ASSERT_EQ(track.samples().size(), 3U);
  EXPECT_EQ(track.samples()[0].position_enu_m.x(), 0.0);
  EXPECT_EQ(track.samples()[2].position_enu_m.x(), 2.0);
}

TEST(TruthTrack, interpolatesAttitudeOnlyWhereBothNeighborsHaveOne) {
  TruthSample first = sampleAt(0.0, Vector3::Zero());
  first.q_flu_to_enu = quaternionFromRotationVector({0.0, 0.0, 0.0});
  TruthSample second = sampleAt(1.0, Vector3::Zero());
  second.q_flu_to_enu = quaternionFromRotationVector({0.0, 0.0, 0.8});
  const TruthTrack track({first, second, sampleAt(2.0, Vector3::Zero())});
  const auto sample = track.at(fromSeconds(0.25));
  ASSERT_TRUE(sample && sample->q_flu_to_enu);
  EXPECT_NEAR(rotationVectorFromQuaternion(*sample->q_flu_to_enu).z(), 0.2, 1e-12);
  ASSERT_TRUE(track.at(fromSeconds(1.5)).has_value());
  EXPECT_FALSE(track.at(fromSeconds(1.5))->q_flu_to_enu.has_value());
}

TEST(TruthTrack, placesFixesInTheLocalFrame) {
  const Geodetic origin{degToRad(39.6), degToRad(-79.9), 250.0};
  const LocalFrame frame(Planet::byName("earth"), origin);
  const Vector3 expected(30.0, -40.0, 2.0);
  const Geodetic position = frame.toGeodetic(expected);
  GnssFix fix;
  fix.stamp = 7;
  fix.latitude_deg = radToDeg(position.latitude_rad);
  fix.longitude_deg = radToDeg(position.longitude_rad);
  fix.height_m = position.height_m;
  fix.covariance_ned_m2 = Vector3(1.0, 4.0, 9.0).asDiagonal();
  const TruthTrack track = TruthTrack::fromFixes({fix}, frame);
  ASSERT_EQ(track.samples().size(), 1U);
  EXPECT_EQ(track.samples()[0].stamp, 7);
  EXPECT_LT((track.samples()[0].position_enu_m - expected).norm(), 1e-6);
  // north, east, down variances become east, north, up ones
  EXPECT_LT((track.samples()[0].covariance_enu_m2.diagonal() - Vector3(4.0, 1.0, 9.0)).norm(), 1e-3);
}

TEST(TruthTrack, refusesWhatItCannotUse) {
  EXPECT_THROW(TruthTrack({sampleAt(0.0, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0})}),
               std::invalid_argument);
  EXPECT_THROW(TruthTrack({}, 0.0), std::invalid_argument);
}

TEST(Estimate, interpolatesPositionCovarianceAttitudeAndSpeed) {
  EstimateSample first;
  first.stamp = 0;
  first.slip = 0.1;
  first.stationary = true;
  EstimateSample second;
  second.stamp = fromSeconds(0.1);
  second.position_enu_m = {1.0, 2.0, 3.0};
  second.covariance_enu_m2 = 4.0 * Matrix3::Identity();
  second.q_flu_to_enu = quaternionFromRotationVector({0.0, 0.0, 0.4});
  second.speed_mps = 0.8;
  const auto sample = interpolate({first, second}, fromSeconds(0.025), 1.0);
  ASSERT_TRUE(sample.has_value());
  EXPECT_EQ(sample->stamp, fromSeconds(0.025));
  EXPECT_LT((sample->position_enu_m - Vector3(0.25, 0.5, 0.75)).norm(), 1e-12);
  EXPECT_LT((sample->covariance_enu_m2 - Matrix3::Identity()).norm(), 1e-12);
  EXPECT_NEAR(rotationVectorFromQuaternion(sample->q_flu_to_enu).z(), 0.1, 1e-12);
  EXPECT_NEAR(sample->speed_mps, 0.2, 1e-12);
  EXPECT_EQ(sample->slip, std::optional<double>(0.1));
  EXPECT_TRUE(sample->stationary);
  EXPECT_FALSE(interpolate({first, second}, fromSeconds(0.025), 0.05).has_value());
}

}  // namespace
}  // namespace slipnav
