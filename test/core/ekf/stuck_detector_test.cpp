#include "slipnav/core/ekf/stuck_detector.h"

#include <gtest/gtest.h>

#include "slipnav/core/base/types.h"

namespace slipnav::test {
namespace {

constexpr double kInterval_s = 0.1;

/// Of a rover that hangs on a stone: the wheels turn at 0.8 m/s, everything else says rest.
SpinEvidence spinning() {
  SpinEvidence evidence;
  evidence.level_of_rest = true;
  evidence.calmer_than_driving = true;
  evidence.forward_mps = 0.05;
  evidence.forward_std_mps = 0.04;
  evidence.wheels_mps = 0.8;
  return evidence;
}

class StuckDetectorTest : public ::testing::Test {
 protected:
  /// The verdict after `duration_s` of the same evidence.
  bool judge(SpinEvidence evidence, double duration_s) {
    bool stuck = false;
    for (double t_s = 0.0; t_s < duration_s - 0.5 * kInterval_s; t_s += kInterval_s) {
      evidence.stamp = fromSeconds(now_s_ += kInterval_s);
      stuck = detector_.judge(evidence);
    }
    return stuck;
  }

  StuckDetector detector_;
  double now_s_ = 1000.0;
};

TEST_F(StuckDetectorTest, TakesASecondOfAgreement) {
  EXPECT_FALSE(judge(spinning(), 0.9));
  EXPECT_TRUE(detector_.isSuspected());
  EXPECT_TRUE(judge(spinning(), 0.3));
  EXPECT_TRUE(detector_.isStuck());
}

TEST_F(StuckDetectorTest, AShakenRoverDrives) {
  SpinEvidence evidence = spinning();
  evidence.calmer_than_driving = false;
  EXPECT_FALSE(judge(evidence, 10.0));
  EXPECT_FALSE(detector_.isSuspected());
}

TEST_F(StuckDetectorTest, ARoverThatTurnsDrives) {
  SpinEvidence evidence = spinning();
  evidence.level_of_rest = false;
  EXPECT_FALSE(judge(evidence, 10.0));
}

TEST_F(StuckDetectorTest, ASpeedThatIsNotKnownIsNoEvidence) {
  SpinEvidence evidence = spinning();
  evidence.forward_std_mps = 0.12;
  EXPECT_FALSE(judge(evidence, 10.0));
}

TEST_F(StuckDetectorTest, SandThatTakesHalfTheWayIsNoStandstill) {
  SpinEvidence evidence = spinning();
  evidence.forward_mps = 0.4;
  EXPECT_FALSE(judge(evidence, 10.0));
}

TEST_F(StuckDetectorTest, OnceStuckTheEstimateNoLongerDecides) {
  ASSERT_TRUE(judge(spinning(), 2.0));
  SpinEvidence drifted = spinning();
  drifted.forward_mps = 0.5;
  EXPECT_TRUE(judge(drifted, 1.0));
}

/// Before it is found out, the wheels pull the estimate along.
TEST_F(StuckDetectorTest, ItNeedNotSeemSlowToTheEnd) {
  SpinEvidence pulled = spinning();
  pulled.forward_mps = 0.2;
  EXPECT_FALSE(judge(spinning(), 0.4));
  EXPECT_FALSE(judge(pulled, 2.0)) << "too short";
  EXPECT_FALSE(judge(spinning(), 0.7));
  EXPECT_TRUE(judge(pulled, 0.5));
}

TEST_F(StuckDetectorTest, EndsWithTheCalm) {
  ASSERT_TRUE(judge(spinning(), 2.0));
  SpinEvidence free = spinning();
  free.calmer_than_driving = false;
  EXPECT_FALSE(judge(free, 0.1));
  EXPECT_FALSE(judge(spinning(), 0.9));
}

}  // namespace
}  // namespace slipnav::test
