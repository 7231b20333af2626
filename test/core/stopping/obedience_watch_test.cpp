#include "core/stopping/obedience_watch.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

class Obedience : public ::testing::Test {
 protected:
  void during(double duration_s, std::optional<double> told_mps, double forward_mps, bool wheels_at_rest = false) {
    for (Nanoseconds end = stamp_ + fromSeconds(duration_s); stamp_ < end;) {
      stamp_ += fromSeconds(0.1);
      watch_.observe(told_mps, {stamp_, forward_mps, 0.01, false, true, wheels_at_rest});
    }
  }

  ObedienceWatch watch_;
  Nanoseconds stamp_ = fromSeconds(1000.0);
};

TEST_F(Obedience, ARoverThatDrivesOnIsNamedWithinTwoSeconds) {
  during(1.5, 0.0, 0.8);
  EXPECT_FALSE(watch_.isIgnored()) << "it may still follow";
  during(0.5, 0.0, 0.8);
  EXPECT_TRUE(watch_.isIgnored());
  during(0.1, 0.0, 0.1);
  EXPECT_FALSE(watch_.isIgnored()) << "it stands, or nearly so";
}

TEST_F(Obedience, OneThatHasFollowedInBetweenIsGivenTimeAgain) {
  during(1.5, 0.0, 0.8);
  during(0.1, 0.8, 0.8);
  during(1.5, 0.0, 0.8);
  EXPECT_FALSE(watch_.isIgnored());
}

TEST_F(Obedience, InReverseAsWell) {
  during(2.0, 0.0, -0.8);
  EXPECT_TRUE(watch_.isIgnored());
}

TEST_F(Obedience, OneThatFollowsIsNot) {
  for (double told_mps = 0.8; told_mps > 0.0; told_mps -= 0.05) {
    during(0.1, told_mps, told_mps + 0.1);
  }
  during(5.0, 0.0, 0.05);
  EXPECT_FALSE(watch_.isIgnored());
}

TEST_F(Obedience, NobodyIsIgnoredWhoSaysNothingAndASlideIsNoDrive) {
  during(5.0, std::nullopt, 0.8);
  EXPECT_FALSE(watch_.isIgnored());
  during(5.0, 0.0, 0.8, true);
  EXPECT_FALSE(watch_.isIgnored());
}

}  // namespace
}  // namespace slipnav
