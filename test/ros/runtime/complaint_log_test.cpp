#include "ros/runtime/complaint_log.h"

#include <gtest/gtest.h>

namespace slipnav::test {
namespace {

const char* const kComplaint = "stamps of joint_states are zero";

TEST(ComplaintLog, SaysEachComplaintAtOnceAndThenEveryMinuteWithItsCount) {
  ComplaintLog log;
  EXPECT_EQ(log.add(kComplaint, 1000.0), kComplaint);
  for (int i = 1; i < 600; ++i) {
    EXPECT_EQ(log.add(kComplaint, 1000.0 + 0.1 * i), "");
  }
  EXPECT_EQ(log.add("another", 1030.0), "another");
  EXPECT_EQ(log.add(kComplaint, 1061.0), std::string(kComplaint) + " (600 times since it was last said)");
  EXPECT_EQ(log.add(kComplaint, 1062.0), "");
}

TEST(ComplaintLog, DoesNotGrowWithoutBounds) {
  ComplaintLog log;
  for (int i = 0; i < 5000; ++i) {
    EXPECT_NE(log.add("number " + std::to_string(i), 0.0), "");
  }
  EXPECT_EQ(log.add("number 4999", 1.0), "");
}

}  // namespace
}  // namespace slipnav::test
