#include "evaluation/truth_gate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "evaluation/motion.h"

namespace slipnav {
namespace {

/// A drive with 0.8 m/s at 10 Hz after 30 s of rest; one row in twenty is 25 m off.
TruthTrack drive(bool with_jumps) {
  std::vector<TruthSample> samples;
  for (int i = 0; i < 900; ++i) {
    TruthSample sample;
    sample.stamp = fromSeconds(0.1 * i);
    sample.position_enu_m = {0.08 * std::max(i - 300, 0) + (with_jumps && i % 20 == 0 ? 25.0 : 0.0), 0.0, 0.0};
    samples.push_back(sample);
  }
  return TruthTrack(samples);
}

TEST(TruthGate, leavesOutJumps) {
  const TruthTrack kept = withoutJumps(drive(true));
  EXPECT_EQ(kept.samples().size(), 855U);
  EXPECT_NEAR(distanceDriven(kept, 0, fromSeconds(90.0)), 47.9, 0.5);
}

TEST(TruthGate, leavesGoodTruthAlone) {
  EXPECT_EQ(withoutJumps(drive(false)).samples().size(), 900U);
  std::vector<TruthSample> sparse;  // motion capture once a second, in turns
  for (int i = 0; i < 100; ++i) {
    TruthSample sample;
    sample.stamp = fromSeconds(i);
    sample.position_enu_m = {2.0 * std::cos(0.4 * i), 2.0 * std::sin(0.4 * i), 0.0};
    sparse.push_back(sample);
  }
  EXPECT_EQ(withoutJumps(TruthTrack(sparse)).samples().size(), 100U);
}

TEST(TruthGate, judgesFixes) {
  std::vector<GnssFix> fixes;
  for (int i = 0; i < 100; ++i) {
    fixes.push_back({fromSeconds(i + 1), 39.6 + 1e-6 * i, -79.9, i == 40 ? 270.0 : 250.0, 1e-4 * Matrix3::Identity()});
  }
  const std::set<Nanoseconds> stamps = stampsWithoutJumps(fixes);
  EXPECT_EQ(stamps.size(), 99U);
  EXPECT_EQ(stamps.count(fixes[40].stamp), 0U);
  EXPECT_TRUE(stampsWithoutJumps({}).empty());
}

TEST(TruthGate, wantsTimeInCommon) {
  EstimateTrack estimates(1);
  estimates[0].stamp = fromSeconds(45.0);
  EXPECT_NO_THROW(requireTimeInCommon(drive(false), estimates));
  estimates[0].stamp = fromSeconds(86400.0);
  EXPECT_THROW(requireTimeInCommon(drive(false), estimates), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav
