#include "evaluation/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace slipnav {
namespace {

/// Position [m] and path length [m] of a drive with stops: speed ramps between 0 and 0.8 m/s, heading swings, ground
/// rises and falls. Integrated finely, so that the path length is known.
struct Drive {
  std::vector<Vector3> position_m;
  std::vector<double> length_m;
  static constexpr double kStepS = 0.001;
};

Drive curvedDriveWithStops(double duration_s) {
  Drive drive;
  Vector3 position = Vector3::Zero();
  double length_m = 0.0;
  double heading_rad = 0.0;
  for (double t = 0.0; t < duration_s; t += Drive::kStepS) {
    drive.position_m.push_back(position);
    drive.length_m.push_back(length_m);
    // 30 s of driving and 10 s of standing, ramps of 1 s
    const double phase_s = std::fmod(t, 40.0);
    const double speed_mps = 0.8 * std::max(0.0, std::min({1.0, phase_s - 5.0, 35.0 - phase_s}));
    const double slope = 0.15 * std::sin(0.3 * length_m);
    heading_rad += 0.4 * std::sin(0.35 * t) * (speed_mps / 0.8) * Drive::kStepS;
    const Vector3 direction(std::cos(slope) * std::cos(heading_rad), std::cos(slope) * std::sin(heading_rad),
                            std::sin(slope));
    position += speed_mps * Drive::kStepS * direction;
    length_m += speed_mps * Drive::kStepS;
  }
  return drive;
}

TruthTrack sampled(
    const Drive& drive, double rate_hz, double noise_m, std::uint64_t seed,
    const std::function<bool(double)>& keep = [](double) { return true; }) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, noise_m > 0.0 ? noise_m : 1.0);
  std::vector<TruthSample> samples;
  const auto step = static_cast<std::size_t>(std::lround(1.0 / (rate_hz * Drive::kStepS)));
  for (std::size_t i = 0; i < drive.position_m.size(); i += step) {
    const double t_s = static_cast<double>(i) * Drive::kStepS;
    TruthSample sample;
    sample.stamp = fromSeconds(t_s);
    sample.position_enu_m = drive.position_m[i];
    if (noise_m > 0.0) {
      sample.position_enu_m += Vector3(noise(random), noise(random), noise(random));
    }
    if (keep(t_s)) {
      samples.push_back(sample);
    }
  }
  return TruthTrack(samples);
}

constexpr Nanoseconds kForever = 4'000'000'000'000'000'000;

TEST(DistanceDriven, holdsTwoPerMilleOnANoisyCurvedDrive) {
  const Drive drive = curvedDriveWithStops(400.0);
  const double length_m = drive.length_m.back();
  ASSERT_GT(length_m, 200.0);
  for (const double noise_m : {0.0, 0.01, 0.02}) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
      const TruthTrack truth = sampled(drive, 10.0, noise_m, seed);
      EXPECT_NEAR(distanceDriven(truth, 0, kForever), length_m, 0.002 * length_m) << noise_m << " m, seed " << seed;
    }
  }
}

TEST(DistanceDriven, standsOtherRates) {
  const Drive drive = curvedDriveWithStops(400.0);
  const double length_m = drive.length_m.back();
  EXPECT_NEAR(distanceDriven(sampled(drive, 50.0, 0.02, 1), 0, kForever), length_m, 0.002 * length_m);
  EXPECT_NEAR(distanceDriven(sampled(drive, 5.0, 0.01, 1), 0, kForever), length_m, 0.002 * length_m);
  EXPECT_NEAR(distanceDriven(sampled(drive, 1.0, 0.002, 1), 0, kForever), length_m, 0.002 * length_m);
}

TEST(DistanceDriven, followsTightTurnsBetweenSparseSamples) {
  // a circle of 1.6 m radius at 0.8 m/s: chords at 1 Hz are 1 % short
  Drive circle;
  for (int i = 0; i <= 60'000; ++i) {
    const double angle = 0.5 * Drive::kStepS * i;
    circle.position_m.emplace_back(1.6 * std::cos(angle), 1.6 * std::sin(angle), 0.0);
  }
  EXPECT_NEAR(distanceDriven(sampled(circle, 1.0, 0.0, 1), 0, kForever), 48.0, 0.002 * 48.0);
  EXPECT_NEAR(distanceDriven(sampled(circle, 10.0, 0.0, 1), 0, kForever), 48.0, 0.002 * 48.0);
}

TEST(DistanceDriven, doesNotGrowAtStandstill) {
  Drive still;
  still.position_m.assign(600'000, Vector3(3.0, 4.0, 5.0));
  EXPECT_LT(distanceDriven(sampled(still, 10.0, 0.02, 7), 0, kForever), 0.3);
  EXPECT_EQ(distanceDriven(sampled(still, 10.0, 0.0, 7), 0, kForever), 0.0);
  // ten minutes at 1 Hz: a sum of chords would be 27 m
  EXPECT_LT(distanceDriven(sampled(still, 1.0, 0.02, 7), 0, kForever), 1.5);
}

TEST(DistanceDriven, takesTheStraightLineAcrossGaps) {
  Drive straight;
  for (int i = 0; i <= 100'000; ++i) {
    straight.position_m.emplace_back(0.0005 * i, 0.0, 0.0);
  }
  const TruthTrack gappy = sampled(straight, 10.0, 0.0, 1, [](double t_s) { return t_s < 30.0 || t_s > 60.0; });
  EXPECT_NEAR(distanceDriven(gappy, 0, kForever), 50.0, 1e-6);
}

TEST(DistanceDriven, countsOnlyTheSpanAskedFor) {
  Drive straight;
  for (int i = 0; i <= 100'000; ++i) {
    straight.position_m.emplace_back(0.0005 * i, 0.0, 0.0);
  }
  const TruthTrack truth = sampled(straight, 10.0, 0.0, 1);
  EXPECT_NEAR(distanceDriven(truth, fromSeconds(20.0), fromSeconds(50.0)), 15.0, 1e-6);
  EXPECT_EQ(distanceDriven(truth, fromSeconds(200.0), fromSeconds(300.0)), 0.0);
  EXPECT_EQ(distanceDriven(TruthTrack(), 0, kForever), 0.0);
  // too few samples for the fit
  EXPECT_NEAR(distanceDriven(truth, fromSeconds(20.0), fromSeconds(20.3)), 0.15, 1e-9);
}

TEST(DistanceDriven, canLeaveHeightOut) {
  Drive slope;
  for (int i = 0; i <= 100'000; ++i) {
    slope.position_m.emplace_back(0.0006 * i, 0.0, 0.0008 * i);
  }
  const TruthTrack truth = sampled(slope, 10.0, 0.0, 1);
  DistanceOptions options;
  EXPECT_NEAR(distanceDriven(truth, 0, kForever, options), 100.0, 1e-6);
  options.horizontal = true;
  EXPECT_NEAR(distanceDriven(truth, 0, kForever, options), 60.0, 1e-6);
}

/// An estimate at 50 Hz that stands in the given intervals [s], begin included, end not.
EstimateTrack standingIn(const std::vector<std::pair<double, double>>& intervals_s, double duration_s) {
  EstimateTrack estimates;
  for (int i = 0; i <= static_cast<int>(std::lround(duration_s * 50.0)); ++i) {
    EstimateSample sample;
    sample.stamp = i * fromSeconds(0.02);
    for (const auto& [begin_s, end_s] : intervals_s) {
      sample.stationary =
          sample.stationary || (sample.stamp >= fromSeconds(begin_s) && sample.stamp < fromSeconds(end_s));
    }
    estimates.push_back(sample);
  }
  return estimates;
}

TEST(FindStops, leavesOutTheStandingBeforeAndAfterTheDrive) {
  const auto stops = findStops(standingIn({{0.0, 10.0}, {30.0, 33.0}, {50.0, 52.0}, {90.0, 101.0}}, 100.0));
  ASSERT_EQ(stops.size(), 2U);
  EXPECT_EQ(stops[0].begin, fromSeconds(30.0));
  EXPECT_EQ(stops[0].end, fromSeconds(33.0));
  EXPECT_EQ(stops[1].begin, fromSeconds(50.0));
  EXPECT_EQ(stops[1].end, fromSeconds(52.0));
}

TEST(FindStops, bridgesFlickerAndIgnoresMoments) {
  const auto stops =
      findStops(standingIn({{20.0, 21.0}, {21.4, 22.0}, {40.0, 40.48}, {60.0, 61.0}, {61.5, 63.0}}, 80.0));
  ASSERT_EQ(stops.size(), 3U);
  EXPECT_EQ(stops[0].begin, fromSeconds(20.0));
  EXPECT_EQ(stops[0].end, fromSeconds(22.0));
  EXPECT_EQ(stops[1].end, fromSeconds(61.0));
  EXPECT_EQ(stops[2].begin, fromSeconds(61.5));
}

TEST(FindStops, isNotFooledByFlickerAtTheEnds) {
  // a detector that needs a moment at first, and one twitch in the standing at each end
  EXPECT_TRUE(findStops(standingIn({{0.3, 4.0}, {4.2, 10.0}, {90.0, 95.0}, {95.1, 99.8}}, 100.0)).empty());
}

TEST(FindStops, findsNoneWhereThereIsNoMotionOrNoStandstill) {
  EXPECT_TRUE(findStops(standingIn({{0.0, 11.0}}, 10.0)).empty());
  EXPECT_TRUE(findStops(standingIn({}, 10.0)).empty());
  EXPECT_TRUE(findStops({}).empty());
}

}  // namespace
}  // namespace slipnav
