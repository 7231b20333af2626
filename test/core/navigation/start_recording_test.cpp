#include "slipnav/core/navigation/start_recording.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

constexpr double kGravity_mps2 = 9.81;

/// Rest and drive in turns, from `from_s` to `to_s`.
void add(StartRecording& recording, double from_s, double to_s, bool at_rest) {
  for (int i = 1; i <= static_cast<int>((to_s - from_s) * 50.0 + 0.5); ++i) {
    const double t_s = from_s + 0.02 * i;
    const double shake = at_rest ? 0.0 : (i % 2 == 0 ? 1.0 : -1.0);
    recording.push(ImuSample{fromSeconds(t_s), Vector3(shake, 0.0, -kGravity_mps2), Vector3(0.0, 0.0, 0.2 * shake)});
    if (i % 5 == 0) {
      WheelMotion wheels;
      wheels.stamp = fromSeconds(t_s);
      wheels.motion.forward_mps = wheels.largest_speed_mps = at_rest ? 0.0 : 0.5;
      recording.push(wheels);
    }
  }
}

/// Fixes may only come after a first rest and its drive: then the next rest counts.
TEST(StartRecording, ALaterRestTakesThePlaceOfTheFirst) {
  StartRecording recording(StationaryParams{}, ImuFloor{}, kGravity_mps2, 5.0, 60.0);
  add(recording, 100.0, 120.0, true);
  add(recording, 120.0, 140.0, false);
  EXPECT_TRUE(recording.rest().over);
  add(recording, 140.0, 150.0, true);
  EXPECT_FALSE(recording.rest().over);
  EXPECT_GE(recording.rest().begin, fromSeconds(140.0));
  EXPECT_GE(recording.imu().front().stamp, fromSeconds(140.0));
  add(recording, 150.0, 160.0, false);
  EXPECT_TRUE(recording.rest().over);
  EXPECT_TRUE(recording.restIsLongEnough());
}

TEST(StartRecording, AShortHaltInTheDriveIsNoRest) {
  StartRecording recording(StationaryParams{}, ImuFloor{}, kGravity_mps2, 5.0, 60.0);
  add(recording, 100.0, 120.0, true);
  add(recording, 120.0, 140.0, false);
  const Nanoseconds begin = recording.rest().begin;
  add(recording, 140.0, 143.0, true);
  add(recording, 143.0, 150.0, false);
  EXPECT_EQ(recording.rest().begin, begin);
}

TEST(StartRecording, FindsTheSampleOfAStampAndTheNextOne) {
  StartRecording recording(StationaryParams{}, ImuFloor{}, kGravity_mps2, 5.0, 60.0);
  add(recording, 100.0, 110.0, true);
  EXPECT_EQ(recording.firstImuStampFrom(fromSeconds(105.0)), fromSeconds(105.0));
  EXPECT_EQ(recording.firstImuStampFrom(fromSeconds(105.0) + 1), fromSeconds(105.02));
  EXPECT_EQ(recording.firstImuStampFrom(fromSeconds(110.0) + 1), std::nullopt);
}

TEST(StartRecording, AWindowDoesNotBeginBeforeAGap) {
  StartRecording recording(StationaryParams{}, ImuFloor{}, kGravity_mps2, 5.0, 60.0);
  add(recording, 100.0, 104.0, true);
  add(recording, 107.0, 110.0, true);
  EXPECT_EQ(recording.windowBeginFrom(fromSeconds(102.0), 1.0), fromSeconds(102.0));
  EXPECT_EQ(recording.windowBeginFrom(fromSeconds(104.0), 1.0), fromSeconds(107.02));
  EXPECT_EQ(recording.windowBeginFrom(fromSeconds(104.0), 4.0), fromSeconds(104.0)) << "a window longer than the gap";
  EXPECT_EQ(recording.windowBeginFrom(fromSeconds(110.0), 1.0), std::nullopt);
}

TEST(StartRecording, DoesNotGrowWithoutBound) {
  StartRecording recording(StationaryParams{}, ImuFloor{}, kGravity_mps2, 5.0, 60.0);
  add(recording, 100.0, 120.0, true);
  add(recording, 120.0, 1120.0, false);
  EXPECT_LT(toSeconds(recording.imu().back().stamp - recording.imu().front().stamp), 400.0);
  EXPECT_FALSE(recording.restIsLongEnough());
}

}  // namespace
}  // namespace slipnav
