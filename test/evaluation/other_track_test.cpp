#include "evaluation/other_track.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slipnav::test {
namespace {

constexpr double kSpeed_mps = 1.0;
constexpr double kStep_s = 0.5;
constexpr double kDrive_s = 120.0;
constexpr double kDrift = 0.02;  // to the left, of the way beyond the aligned part
constexpr double kStraight_m = 40.0;

/// Straight ahead, then a quarter turn to the left, in the map frame.
Vector3 placeAt(double t_s) {
  const double way_m = kSpeed_mps * t_s;
  return way_m < 60.0 ? Vector3(way_m, 5.0, 1.0) : Vector3(60.0, 5.0 + way_m - 60.0, 1.0);
}

Nanoseconds stampAt(double t_s) { return fromSeconds(1000.0 + t_s); }

TruthTrack truthOf() {
  std::vector<TruthSample> samples;
  for (double t_s = 0.0; t_s <= kDrive_s; t_s += kStep_s) {
    samples.push_back({stampAt(t_s), placeAt(t_s)});
  }
  return TruthTrack(samples);
}

EstimateTrack estimatesOf() {
  EstimateTrack track;
  for (double t_s = 10.0; t_s <= kDrive_s; t_s += kStep_s) {
    EstimateSample sample;
    sample.stamp = stampAt(t_s);
    sample.position_enu_m = placeAt(t_s);
    sample.covariance_enu_m2.setIdentity();
    sample.speed_mps = kSpeed_mps;
    track.push_back(sample);
  }
  return track;
}

/// As somebody sees the drive who begins elsewhere with a heading of its own, and strays once it is under way.
std::vector<TumPose> posesOf(double drift) {
  const Quaternion turn(Eigen::AngleAxisd(2.0, Vector3::UnitZ()));
  std::vector<TumPose> poses;
  for (double t_s = 0.0; t_s <= kDrive_s; t_s += 0.2) {
    const double strayed_m = drift * std::max(0.0, kSpeed_mps * (t_s - 10.0) - kStraight_m);
    poses.push_back(
        {stampAt(t_s), turn * (placeAt(t_s) + Vector3(0.0, strayed_m, 0.0)) + Vector3(100.0, -50.0, 7.0), turn});
  }
  return poses;
}

TEST(OtherTrack, WhereItBeginsAndHeadsIsNobodysError) {
  const OtherTrack other = besideTheEstimate("vio", posesOf(0.0), estimatesOf(), truthOf());
  EXPECT_EQ(other.name, "vio");
  EXPECT_NEAR(other.metrics.horizontal_max_m.value(), 0.0, 1e-6);
  EXPECT_NEAR(other.metrics.rms_up_m.value(), 0.0, 1e-6);
  EXPECT_NEAR(other.metrics.distance_m.value(), 110.0, 1.0);
  EXPECT_GE(other.estimates.front().stamp, stampAt(10.0));
  EXPECT_NEAR(other.estimates.back().q_flu_to_enu.angularDistance(Quaternion::Identity()), 0.0, 1e-6);
}

TEST(OtherTrack, WhatItStraysIs) {
  const OtherTrack other = besideTheEstimate("vio", posesOf(kDrift), estimatesOf(), truthOf());
  EXPECT_NEAR(other.metrics.horizontal_final_m.value(), kDrift * (110.0 - kStraight_m), 0.01);
  EXPECT_GT(other.metrics.enu_error_pct.value(), 0.3);
}

TEST(OtherTrack, HasNoCovarianceToBeJudged) {
  const OtherTrack other = besideTheEstimate("vio", posesOf(kDrift), estimatesOf(), truthOf());
  EXPECT_FALSE(other.metrics.position_nees_mean);
  EXPECT_FALSE(other.metrics.coverage_3sigma_pct);
}

TEST(OtherTrack, WithoutTruthItIsPutBesideTheEstimate) {
  const OtherTrack other = besideTheEstimate("vio", posesOf(0.0), estimatesOf(), TruthTrack());
  EXPECT_FALSE(other.metrics.enu_error_pct);
  const EstimateSample& last = other.estimates.back();
  EXPECT_NEAR((last.position_enu_m - placeAt(toSeconds(last.stamp - stampAt(0.0)))).norm(), 0.0, 1e-6);
}

TEST(OtherTrack, OfAnotherTimeIsRefusedByName) {
  std::vector<TumPose> poses = posesOf(0.0);
  for (TumPose& pose : poses) {
    pose.stamp += fromSeconds(1e6);
  }
  try {
    besideTheEstimate("vio", poses, estimatesOf(), truthOf());
    FAIL() << "was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "compare vio: no pose in the time of the drive; are its stamps those of the recording?");
  }
}

}  // namespace
}  // namespace slipnav::test
