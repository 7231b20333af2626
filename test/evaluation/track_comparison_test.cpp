#include "evaluation/track_comparison.h"

#include <gtest/gtest.h>

namespace slipnav::test {
namespace {

EstimateSample at(Nanoseconds stamp, double east_m) {
  EstimateSample sample;
  sample.stamp = stamp;
  sample.position_enu_m.x() = east_m;
  return sample;
}

TEST(TrackComparison, ComparesWhereBothHaveAnEpoch) {
  const EstimateTrack a = {at(1, 0.0), at(2, 1.0), at(4, 2.0), at(5, 7.0)};
  const EstimateTrack b = {at(2, 1.5), at(3, 9.0), at(4, 2.0)};
  for (const TrackComparison& comparison : {compareTracks(a, b), compareTracks(b, a)}) {
    EXPECT_EQ(comparison.common, 2U);
    EXPECT_EQ(comparison.largest_m, 0.5);
  }
  EXPECT_EQ(compareTracks(a, {}).common, 0U);
}

TEST(TrackComparison, SaysItInALine) {
  EXPECT_EQ(comparisonText("replay", {at(1, 0.25), at(2, 0.0)}, {at(1, 0.0)}),
            "replay: 2 estimates, offline: 1, in common: 1, largest difference: 0.25 m\n");
}

}  // namespace
}  // namespace slipnav::test
