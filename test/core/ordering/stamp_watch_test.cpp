#include "core/ordering/stamp_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace slipnav {
namespace {

constexpr Nanoseconds kStart = 1'600'000'000 * kSecond;

/// What is said in ten seconds of an IMU at 50 Hz and wheels at 10 Hz that are so much ahead of it.
std::string said(double ahead_s, double every_other_s) {
  StampWatch watch("imu/data");
  std::string text;
  for (int i = 0; i < 500; ++i) {
    const Nanoseconds stamp = kStart + i * kSecond / 50;
    watch.noteImu(stamp);
    if (i % 5 == 0) {
      const std::string now = watch.note("joint_states", stamp + fromSeconds(i % 2 == 0 ? ahead_s : every_other_s));
      text = now.empty() ? text : now;
    }
  }
  return text;
}

TEST(StampWatch, NamesClocksThatAreApart) {
  EXPECT_EQ(said(-3.1, -3.1), "stamps of imu/data and joint_states are 3.1 s apart");
  EXPECT_EQ(said(0.8, 0.8), "stamps of imu/data and joint_states are 0.8 s apart");
}

TEST(StampWatch, RecognizesLeapSeconds) {
  EXPECT_EQ(said(18.0, 18.0), "stamps of imu/data and joint_states are 18.0 s apart: is one of them GPS time?");
}

TEST(StampWatch, LeapSecondsAreWithinHalfASecond) {
  for (const double ahead_s : {17.4, 17.6, 18.4, 18.6, -17.6, -18.6}) {
    const bool is_gps_time = std::abs(std::abs(ahead_s) - 18.0) < 0.5;
    EXPECT_EQ(said(ahead_s, ahead_s).find("GPS time") != std::string::npos, is_gps_time) << ahead_s;
  }
}

TEST(StampWatch, MessagesMayBeOnTheirWay) {
  EXPECT_EQ(said(0.0, -0.4), "");
  EXPECT_EQ(said(-0.2, -2.0), "");
  EXPECT_EQ(said(-0.8, -2.0), "") << "late, but not evenly";
}

TEST(StampWatch, StampsThatWereNeverSetAreAnotherMatter) {
  StampWatch watch("imu/data");
  for (int i = 0; i < 100; ++i) {
    watch.noteImu(kStart + i * kSecond / 50);
    EXPECT_EQ(watch.note("joint_states", 0), "");
  }
}

}  // namespace
}  // namespace slipnav
