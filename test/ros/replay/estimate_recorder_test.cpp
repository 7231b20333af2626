#include "ros/replay/estimate_recorder.h"

#include <gtest/gtest.h>

#include "ros/messages/conversions.h"

namespace slipnav::test {
namespace {

constexpr Nanoseconds kBegin = 1600000000 * kSecond;
constexpr Nanoseconds kStep = kSecond / 50;
constexpr Nanoseconds kSetBack = 5 * kSecond;
constexpr int kBefore = 600;  // estimates before the clock changes
constexpr int kAfter = 300;

void record(Nanoseconds stamp, EstimateRecorder& recorder) {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = toRosTime(stamp);
  odometry.pose.pose.orientation.w = 1.0;
  recorder.add(odometry);
  NavState state;
  state.header.stamp = odometry.header.stamp;
  recorder.add(state);
}

/// @param change of the clock after kBefore estimates
EstimateRecorder recorded(Nanoseconds change) {
  EstimateRecorder recorder;
  for (int i = 0; i < kBefore + kAfter; ++i) {
    record(kBegin + i * kStep + (i < kBefore ? 0 : change), recorder);
  }
  return recorder;
}

TEST(EstimateRecorder, GoesOnWhereTheClockIsSetBack) {
  const EstimateRecorder recorder = recorded(-kSetBack);
  EXPECT_EQ(recorder.size(), static_cast<std::size_t>(kBefore + kAfter));
  EXPECT_EQ(recorder.newestStamp(), kBegin + (kBefore + kAfter - 1) * kStep);
  EXPECT_EQ(recorder.track().back().stamp, recorder.newestStamp());
}

TEST(EstimateRecorder, BeginsAgainWithTheRecording) {
  const EstimateRecorder recorder = recorded(-kBefore * kStep);
  EXPECT_EQ(recorder.size(), static_cast<std::size_t>(kAfter));
  EXPECT_EQ(recorder.newestStamp(), kBegin + (kAfter - 1) * kStep);
}

}  // namespace
}  // namespace slipnav::test
