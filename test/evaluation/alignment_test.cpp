#include "evaluation/alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

/// A drive along an arc up a slope, in east-north-up.
EstimateTrack arcDrive() {
  EstimateTrack estimates;
  for (int i = 0; i <= 600; ++i) {
    const double angle = 0.01 * i;
    EstimateSample sample;
    sample.stamp = fromSeconds(100.0 + 0.1 * i);
    sample.position_enu_m = {5.0 + 8.0 * std::sin(angle), 3.0 + 8.0 - 8.0 * std::cos(angle), 0.1 * angle};
    sample.q_flu_to_enu =
        quaternionFromRotationVector({0.0, 0.0, angle}) * quaternionFromRotationVector({0.05, -0.1, 0.0});
    estimates.push_back(sample);
  }
  return estimates;
}

/// The same drive as told in another frame.
TruthTrack seenFrom(const Vector3& origin_m, const Quaternion& q_frame_to_enu, const EstimateTrack& estimates,
                    bool with_attitude = true) {
  std::vector<TruthSample> samples;
  for (std::size_t i = 0; i < estimates.size(); i += 5) {
    TruthSample sample;
    sample.stamp = estimates[i].stamp;
    sample.position_enu_m = q_frame_to_enu.conjugate() * (estimates[i].position_enu_m - origin_m);
    if (with_attitude) {
      sample.q_flu_to_enu = q_frame_to_enu.conjugate() * estimates[i].q_flu_to_enu;
    }
    sample.covariance_enu_m2 = Vector3(1.0, 4.0, 9.0).asDiagonal();
    samples.push_back(sample);
  }
  return TruthTrack(samples);
}

double largestError(const TruthTrack& truth, const EstimateTrack& estimates) {
  double largest_m = 0.0;
  for (const TruthSample& sample : truth.samples()) {
    const auto estimate = interpolate(estimates, sample.stamp, 1.0);
    largest_m = std::max(largest_m, (estimate->position_enu_m - sample.position_enu_m).norm());
  }
  return largest_m;
}

TEST(Alignment, fullPoseUndoesAnyFrame) {
  const EstimateTrack drive = arcDrive();
  const TruthTrack local = seenFrom(drive.front().position_enu_m, drive.front().q_flu_to_enu, drive);
  EXPECT_GT(largestError(local, drive), 1.0);
  const TruthTrack aligned = alignAtStart(local, drive, StartAlignment::kFullPose);
  EXPECT_LT(largestError(aligned, drive), 1e-9);
  EXPECT_LT(aligned.samples().back().q_flu_to_enu->angularDistance(drive.back().q_flu_to_enu), 1e-9);
}

TEST(Alignment, yawUndoesLeveledFramesOnly) {
  const EstimateTrack drive = arcDrive();
  const Vector3 origin(-20.0, 7.0, 3.0);
  const TruthTrack level = seenFrom(origin, quaternionFromRotationVector({0.0, 0.0, 2.0}), drive);
  EXPECT_LT(largestError(alignAtStart(level, drive, StartAlignment::kYaw), drive), 1e-9);
  const TruthTrack leaning = seenFrom(origin, quaternionFromRotationVector({0.2, 0.1, 2.0}), drive);
  EXPECT_GT(largestError(alignAtStart(leaning, drive, StartAlignment::kYaw), drive), 0.3);
  EXPECT_LT(largestError(alignAtStart(leaning, drive, StartAlignment::kFullPose), drive), 1e-9);
}

TEST(Alignment, turnsCovarianceToo) {
  const EstimateTrack drive = arcDrive();
  const TruthTrack quarter_turn = seenFrom(Vector3::Zero(), quaternionFromRotationVector({0.0, 0.0, kPi / 2}), drive);
  const TruthTrack aligned = alignAtStart(quarter_turn, drive, StartAlignment::kYaw);
  EXPECT_LT((aligned.samples()[0].covariance_enu_m2.diagonal() - Vector3(4.0, 1.0, 9.0)).norm(), 1e-9);
}

TEST(Alignment, startsAtTheFirstCommonEpoch) {
  const EstimateTrack drive = arcDrive();
  const TruthTrack local = seenFrom({1.0, 2.0, 3.0}, quaternionFromRotationVector({0.0, 0.0, -1.0}), drive);
  const EstimateTrack later(drive.begin() + 203, drive.end());
  const TruthTrack aligned = alignAtStart(local, later, StartAlignment::kFullPose);
  EXPECT_EQ(aligned.samples().size(), local.samples().size());
  EXPECT_LT((aligned.samples().front().position_enu_m - drive.front().position_enu_m).norm(), 1e-9);
}

TEST(Alignment, saysWhyItCannotAlignAtStart) {
  const EstimateTrack drive = arcDrive();
  const TruthTrack without = seenFrom(Vector3::Zero(), Quaternion::Identity(), drive, false);
  EXPECT_THROW(alignAtStart(without, drive, StartAlignment::kYaw), std::invalid_argument);
  EXPECT_THROW(alignAtStart(TruthTrack(), drive, StartAlignment::kYaw), std::invalid_argument);
  EXPECT_THROW(alignAtStart(without, EstimateTrack(), StartAlignment::kYaw), std::invalid_argument);
}

TEST(Alignment, findsHeadingOffsetWhateverTheShiftAndNoise) {
  const EstimateTrack drive = arcDrive();
  const double offset_rad = 0.3;
  const TruthTrack exact = seenFrom({4.0, -2.0, 0.0}, quaternionFromRotationVector({0.0, 0.0, offset_rad}), drive);
  EXPECT_NEAR(headingOffset(exact, drive, 30.0), offset_rad, 1e-9);

  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 0.5);
  std::vector<TruthSample> samples = exact.samples();
  for (TruthSample& sample : samples) {
    sample.position_enu_m += Vector3(noise(random), noise(random), 0.0);
  }
  // 76 epochs of 0.5 m noise over an arc with 5 m of spread: sigma is about 0.01 rad
  EXPECT_NEAR(headingOffset(TruthTrack(samples), drive, 30.0), offset_rad, 0.04);
}

TEST(Alignment, headingOffsetLooksAtTheFirstMetresOnly) {
  const EstimateTrack drive = arcDrive();
  std::vector<TruthSample> samples = seenFrom(Vector3::Zero(), Quaternion::Identity(), drive).samples();
  for (std::size_t i = samples.size() / 2; i < samples.size(); ++i) {
    samples[i].position_enu_m.x() += 10.0;
  }
  EXPECT_NEAR(headingOffset(TruthTrack(samples), drive, 20.0), 0.0, 1e-9);
  EXPECT_GT(std::abs(headingOffset(TruthTrack(samples), drive, 48.0)), 0.05);
}

TEST(Alignment, turnsHeadingAboutTheStart) {
  const EstimateTrack drive = arcDrive();
  const TruthTrack turned =
      seenFrom(drive.front().position_enu_m, quaternionFromRotationVector({0.0, 0.0, 0.3}), drive);
  std::vector<TruthSample> samples = turned.samples();
  for (TruthSample& sample : samples) {
    sample.position_enu_m += drive.front().position_enu_m;
  }
  EXPECT_LT(largestError(alignHeading(TruthTrack(samples), drive), drive), 1e-9);
}

TEST(Alignment, needsMotionToAlignTheHeading) {
  EstimateTrack standing(50);
  for (std::size_t i = 0; i < standing.size(); ++i) {
    standing[i].stamp = fromSeconds(0.1 * static_cast<double>(i));
  }
  EXPECT_THROW(headingOffset(seenFrom(Vector3::Zero(), Quaternion::Identity(), standing), standing, 30.0),
               std::invalid_argument);
  EXPECT_THROW(headingOffset(TruthTrack(), standing, 30.0), std::invalid_argument);
  EXPECT_THROW(headingOffset(TruthTrack(), EstimateTrack(), 30.0), std::invalid_argument);
}

TEST(Alignment, removesTheLeverArmOfAnAntenna) {
  const EstimateTrack drive = arcDrive();
  const Vector3 lever_flu_m(0.2, -0.1, 0.9);
  std::vector<TruthSample> antenna;
  for (std::size_t i = 0; i < drive.size(); i += 5) {
    TruthSample sample;
    sample.stamp = drive[i].stamp;
    sample.position_enu_m = drive[i].position_enu_m + drive[i].q_flu_to_enu * lever_flu_m;
    antenna.push_back(sample);
  }
  antenna.push_back(antenna.back());
  antenna.back().stamp += fromSeconds(1.0);
  const TruthTrack body = removeLeverArm(TruthTrack(antenna), drive, lever_flu_m);
  EXPECT_EQ(body.samples().size(), antenna.size() - 1);
  EXPECT_LT(largestError(body, drive), 1e-9);
}

}  // namespace
}  // namespace slipnav
