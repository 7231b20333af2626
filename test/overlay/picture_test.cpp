/// Truth beside the estimate, and the picture of a whole drive.

#include <gtest/gtest.h>

#include "overlay/drive_view.h"

namespace slipnav {
namespace {

const Geodetic kOrigin{degToRad(39.65), degToRad(-79.9), 300.0};

LocalFrame frame() { return LocalFrame(Planet::byName("earth"), kOrigin); }

/// East at 1 m/s from the origin.
EstimateSample estimateAt(double t_s) {
  EstimateSample estimate;
  estimate.stamp = fromSeconds(t_s);
  estimate.position_enu_m.x() = t_s;
  estimate.covariance_enu_m2 = Matrix3::Identity() * 0.01;
  estimate.speed_mps = 1.0;
  return estimate;
}

GnssFix fixAt(double t_s, const Vector3& position_enu_m) {
  const Geodetic position = frame().toGeodetic(position_enu_m);
  return {fromSeconds(t_s), radToDeg(position.latitude_rad), radToDeg(position.longitude_rad), position.height_m,
          Matrix3::Identity()};
}

TruthSample poseAt(double t_s, const Vector3& position, double yaw_rad) {
  TruthSample sample;
  sample.stamp = fromSeconds(t_s);
  sample.position_enu_m = position;
  sample.q_flu_to_enu = Quaternion(Eigen::AngleAxisd(yaw_rad, Vector3::UnitZ()));
  return sample;
}

TruthParams align(const std::string& how) {
  TruthParams params;
  params.align = how;
  params.heading_distance_m = 5.0;
  return params;
}

TEST(TruthFollower, PlacesFixesByTheOriginOfTheMapAndTakesTheLeverArmOut) {
  TruthFollower follower(align("auto"), {0.5, 0.0, 1.0});
  follower.add(fixAt(2.5, {3.0, 0.25, 1.0}));
  EXPECT_TRUE(follower.follow(estimateAt(2.0), estimateAt(3.0)).empty());  // the origin is not known yet
  follower.start(frame(), kSecond);
  const std::vector<TruthPair> pairs = follower.follow(estimateAt(2.0), estimateAt(3.0));
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR((pairs[0].truth.position_enu_m - Vector3(2.5, 0.25, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR(pairs[0].estimate.position_enu_m.x(), 2.5, 1e-9);
}

TEST(TruthFollower, WaitsForTheEstimateAndLeavesOutWhatWasBeforeTheStart) {
  TruthFollower follower(align("auto"), Vector3::Zero());
  follower.start(frame(), 2 * kSecond);
  for (const double t_s : {0.5, 1.5, 2.5, 3.5}) {
    follower.add(fixAt(t_s, {t_s, 0.0, 0.0}));
  }
  EXPECT_TRUE(follower.follow(estimateAt(1.0), estimateAt(2.0)).empty());
  EXPECT_EQ(follower.follow(estimateAt(2.0), estimateAt(3.0)).size(), 1U);
  EXPECT_EQ(follower.follow(estimateAt(3.0), estimateAt(4.0)).size(), 1U);
}

TEST(TruthFollower, AlignsPosesAtTheStart) {
  TruthFollower follower(align("auto"), Vector3::Zero());
  follower.start(frame(), 0);
  // Truth drives north in a frame of its own.
  follower.add(TruthSource::kOdometry, poseAt(1.0, {100.0, 50.0, 7.0}, 0.5 * kPi));
  follower.add(TruthSource::kOdometry, poseAt(2.0, {100.0, 51.0, 7.0}, 0.5 * kPi));
  std::vector<TruthPair> pairs = follower.follow(estimateAt(0.5), estimateAt(1.5));
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR((pairs[0].truth.position_enu_m - Vector3(1.0, 0.0, 0.0)).norm(), 0.0, 1e-9);
  pairs = follower.follow(estimateAt(1.5), estimateAt(2.5));
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR((pairs[0].truth.position_enu_m - Vector3(2.0, 0.0, 0.0)).norm(), 0.0, 1e-9);
}

TEST(TruthFollower, AlignsTheHeadingOnceTheFirstMetresAreDriven) {
  TruthFollower follower(align("heading"), Vector3::Zero());
  follower.start(frame(), 0);
  std::vector<TruthPair> placed;
  for (int i = 0; i <= 10; ++i) {  // turned by 0.1 rad
    follower.add(fixAt(i, {i * std::cos(0.1), i * std::sin(0.1), 0.0}));
    const std::vector<TruthPair> now = follower.follow(estimateAt(std::max(0, i - 1)), estimateAt(i));
    EXPECT_TRUE(i >= 5 || now.empty());
    placed.insert(placed.end(), now.begin(), now.end());
  }
  ASSERT_EQ(placed.size(), 11U);
  for (const TruthPair& pair : placed) {
    EXPECT_NEAR((pair.truth.position_enu_m - pair.estimate.position_enu_m).head<2>().norm(), 0.0, 1e-4);
  }
}

TEST(TruthFollower, FollowsThePreferredSourceAlone) {
  TruthFollower follower(align("none"), Vector3::Zero());
  follower.start(frame(), 0);
  follower.add(TruthSource::kPose, poseAt(1.0, {1.0, 1.0, 0.0}, 0.0));
  follower.add(fixAt(1.2, {1.2, 2.0, 0.0}));
  follower.add(TruthSource::kOdometry, poseAt(1.3, {1.3, 3.0, 0.0}, 0.0));
  const std::vector<TruthPair> pairs = follower.follow(estimateAt(0.5), estimateAt(2.0));
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR(pairs[0].truth.position_enu_m.y(), 2.0, 1e-6);
}

class Drive : public ::testing::Test {
 protected:
  /// From t = 1 s on, with truth 0.1 m to the north and a stop of 3 s at t = 10 s, after which the estimate is put 3 m
  /// ahead.
  void drive(double until_s) {
    for (int i = 50; i <= static_cast<int>(50.0 * until_s); ++i) {
      const double t_s = 0.02 * i;
      const bool standing = t_s >= 10.0 && t_s <= 13.0;
      EstimateSample estimate = estimateAt(standing ? 10.0 : t_s);
      estimate.stamp = fromSeconds(t_s);
      picture_.add(estimate);
      if (i % 5 == 0) {
        picture_.truthInput().add(fixAt(t_s, estimate.position_enu_m + Vector3(0.0, 0.1, 0.0)));
        picture_.addSlip(estimate.stamp, 0.25, standing);
      }
    }
  }

  OverlayParams params_;
  DriveView picture_{params_, align("auto"), Vector3::Zero()};
};

TEST_F(Drive, NothingIsShownBeforeItBegins) {
  drive(5.0);
  EXPECT_TRUE(picture_.track().points().empty());
  picture_.start(frame(), 3 * kSecond);
  drive(5.0);
  EXPECT_EQ(picture_.track().points().front().stamp, 3 * kSecond);
}

TEST_F(Drive, IsGatheredFromAllThatIsSaid) {
  picture_.start(frame(), kSecond);
  drive(20.0);
  EXPECT_NEAR(picture_.distance(), 16.0, 0.1) << "what the estimate was moved by is not driven";
  EXPECT_NEAR(*picture_.horizontalError(), 0.1, 1e-4);
  EXPECT_NEAR(picture_.horizontalBound(), 0.3, 1e-9);
  EXPECT_EQ(*picture_.slip(), 0.25);
  ASSERT_EQ(picture_.stops().stops().size(), 1U);
  EXPECT_NEAR(picture_.stops().stops()[0].duration_s, 3.0, 0.2);
  EXPECT_NEAR(*picture_.stops().stops()[0].before.true_m, 0.1, 1e-4);
  EXPECT_EQ(*picture_.track().points().back().slip, 0.25);
  EXPECT_GT(picture_.truth().points().size(), 80U);
}

TEST_F(Drive, TruthIsDrawnAtTheHeightOfTheEstimateUnlessAskedOtherwise) {
  for (const bool flat : {true, false}) {
    params_.flat = flat;
    DriveView picture(params_, align("auto"), Vector3::Zero());
    picture.start(frame(), 0);
    picture.truthInput().add(fixAt(1.5, {1.5, 0.0, 7.0}));
    picture.add(estimateAt(1.0));
    picture.add(estimateAt(2.0));
    ASSERT_EQ(picture.truth().points().size(), 1U);
    EXPECT_NEAR(picture.truth().points()[0].position_enu_m.z(), flat ? 0.0 : 7.0, 1e-6);
    EXPECT_NEAR(picture.newestPair()->truth.position_enu_m.z(), 7.0, 1e-6);
  }
}

/// Sensors are ahead of the estimate when its start becomes known late, as in a recording that is played fast.
TEST_F(Drive, DeadReckoningIsDrawnAtTheHeightThatTheEstimateHadThere) {
  picture_.start(frame(), kSecond);
  for (int i = 1; i <= 500; ++i) {
    ImuSample imu;
    imu.stamp = fromSeconds(0.02 * i);
    picture_.wheelInput().add(imu);
    if (i % 5 == 0) {
      picture_.wheelInput().add(SpeedSample{imu.stamp, 1.0});
    }
  }
  for (double t_s = 1.0; t_s <= 8.0; t_s += 0.02) {
    EstimateSample estimate = estimateAt(t_s);
    estimate.position_enu_m.z() = 0.1 * t_s;
    picture_.add(estimate);
  }
  ASSERT_GT(picture_.wheels().points().size(), 20U);
  for (const TrackPoint& point : picture_.wheels().points()) {
    EXPECT_NEAR(point.position_enu_m.z(), 0.1 * toSeconds(point.stamp), 0.01);
  }
  EXPECT_NEAR(toSeconds(picture_.wheels().points().back().stamp), 8.0, 0.5);
}

TEST_F(Drive, AClockThatGoesBackClearsIt) {
  picture_.start(frame(), kSecond);
  drive(20.0);
  const std::uint64_t revision = picture_.revision();
  picture_.add(estimateAt(5.0));
  EXPECT_GT(picture_.revision(), revision);
  EXPECT_EQ(picture_.track().points().size(), 1U);
  EXPECT_TRUE(picture_.truth().points().empty());
  EXPECT_TRUE(picture_.stops().stops().empty());
  EXPECT_EQ(picture_.distance(), 0.0);
}

TEST_F(Drive, WhatIsShownStaysSmallHoweverLongItIs) {
  params_.max_points = 100;
  params_.max_stops = 5;
  DriveView picture(params_, align("auto"), Vector3::Zero());
  picture.start(frame(), 0);
  for (int i = 0; i < 50000; ++i) {
    picture.add(estimateAt(i));
    picture.truthInput().add(fixAt(i, {static_cast<double>(i), 0.0, 0.0}));
    picture.addSlip(fromSeconds(i), std::nullopt, i % 10 < 3);
  }
  EXPECT_LE(picture.track().points().size(), 100U);
  EXPECT_LE(picture.truth().points().size(), 100U);
  EXPECT_EQ(picture.stops().stops().size(), 5U);
}

}  // namespace
}  // namespace slipnav
