/// Stamps, joints and findings by themselves.

#include <gtest/gtest.h>

#include <cmath>

#include "inspection/encoder_check.h"
#include "inspection/stream_check.h"
#include "inspection/wheel_choice.h"

namespace slipnav {
namespace {

std::vector<MessageTime> evenTimes(int count, Nanoseconds interval) {
  std::vector<MessageTime> times;
  for (int i = 0; i < count; ++i) {
    const Nanoseconds stamp = 100 * kSecond + i * interval;
    times.push_back({stamp, stamp});
  }
  return times;
}

TEST(InspectionStreams, CountsWhatIsWrongWithStamps) {
  std::vector<MessageTime> times = evenTimes(1000, kSecond / 100);
  times[10].stamp = times[9].stamp;
  times[20].stamp = 0;
  times[30].stamp = times[29].stamp - 1000;
  for (std::size_t i = 500; i < times.size(); ++i) {
    times[i].stamp += 2 * kSecond;
  }
  const StreamStatistics statistics = statisticsOf(times);
  EXPECT_EQ(statistics.equal, 1U);
  EXPECT_EQ(statistics.zero, 1U);
  EXPECT_EQ(statistics.backwards, 1U);
  ASSERT_EQ(statistics.gaps_s.size(), 1U);
  EXPECT_NEAR(statistics.gaps_s[0], 2.01, 1e-6);
  EXPECT_NEAR(statistics.rate_hz, 100.0, 1.0);
}

TEST(InspectionStreams, SaysNothingOfEvenOnes) {
  Findings findings;
  checkStream("/t", statisticsOf(evenTimes(1000, kSecond / 100)), {20.0, 1000.0, true}, findings);
  EXPECT_TRUE(findings.empty()) << toText(findings);
}

TEST(InspectionStreams, NamesRatesThatAreOfLittleUse) {
  Findings findings;
  checkStream("/t", statisticsOf(evenTimes(100, kSecond)), {20.0, 1000.0, true}, findings);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_NE(findings[0].text.find("1.0 Hz"), std::string::npos);
}

TEST(InspectionStreams, TimeGoesOnWhereAClockIsSetBack) {
  std::vector<MessageTime> times = evenTimes(100, kSecond / 10);
  for (std::size_t i = 50; i < times.size(); ++i) {
    times[i].stamp -= 5 * kSecond;
  }
  const std::vector<double> continuous = continuousTimes(times, 100 * kSecond);
  EXPECT_NEAR(continuous.back(), 9.9, 1e-6);
  EXPECT_NEAR(statisticsOf(times).set_back_s.at(0), 5.0, 1e-6);
}

TEST(InspectionStreams, KnowsSidesByName) {
  EXPECT_EQ(sideOf("front_left_wheel"), Side::kLeft);
  EXPECT_EQ(sideOf("wheel_RR_joint"), Side::kRight);
  EXPECT_EQ(sideOf("fl"), Side::kLeft);
  EXPECT_EQ(sideOf("roller"), Side::kUnknown);
  EXPECT_EQ(sideOf("shoulder_pan"), Side::kUnknown);
}

JointRecord turning(double step_rad, const std::vector<std::string>& names) {
  JointRecord record;
  record.names = names;
  for (int i = 0; i < 400; ++i) {
    const double angle_rad = step_rad * std::floor(0.01 * i * i);
    const Nanoseconds stamp = kSecond + i * kSecond / 10;
    record.samples.push_back({{stamp, stamp}, std::vector<double>(names.size(), angle_rad), {}});
  }
  return record;
}

TEST(InspectionStreams, ChoosesWheelsAmongOtherJoints) {
  const JointRecord record = turning(0.1, {"arm_1", "left_wheel", "front_steer_wheel", "right_wheel"});
  const std::vector<WheelJoint> wheels = wheelsByName(record);
  ASSERT_EQ(wheels.size(), 2U);
  EXPECT_EQ(wheels[0].index, 1U);
  EXPECT_EQ(wheels[1].name, "right_wheel");
}

TEST(InspectionStreams, FindsResolutionAndWrap) {
  JointRecord record = turning(0.05, {"left_wheel"});
  EXPECT_NEAR(pictureOf(record, 0).resolution_rad, 0.05, 1e-9);
  EXPECT_FALSE(pictureOf(record, 0).wraps);
  for (RawJointSample& sample : record.samples) {
    sample.position_rad[0] = std::remainder(sample.position_rad[0], 2.0 * kPi);
  }
  EXPECT_TRUE(pictureOf(record, 0).wraps);
}

TEST(InspectionStreams, WorstFindingsComeFirstAndDecideTheStatus) {
  Findings findings = {{Severity::kRemark, "a", "t", "r"},
                       {Severity::kUnusable, "b", "t", "r"},
                       {Severity::kDoubtful, "c", "t", "r"},
                       {Severity::kDoubtful, "d", "t", "r"}};
  mergeAlike(findings);
  ASSERT_EQ(findings.size(), 3U);
  sortWorstFirst(findings);
  EXPECT_EQ(findings[0].subject, "b");
  EXPECT_EQ(findings[1].subject, "c, d");
  EXPECT_EQ(statusOf(findings), 2);
  EXPECT_EQ(statusOf({findings[1]}), 1);
  EXPECT_EQ(statusOf({findings[2]}), 0);
  EXPECT_EQ(decimal(-0.001, 1), "0.0");
}

}  // namespace
}  // namespace slipnav
