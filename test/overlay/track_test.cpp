/// Tracks for display: thinning, dead reckoning beside the estimate, stops.

#include <gtest/gtest.h>

#include "overlay/drive_view.h"
#include "overlay/stop_log.h"
#include "overlay/thinned_track.h"
#include "overlay/wheel_path.h"

namespace slipnav {
namespace {

TrackPoint pointAt(double east_m, Nanoseconds stamp = 0) {
  TrackPoint point;
  point.stamp = stamp;
  point.position_enu_m.x() = east_m;
  return point;
}

TEST(ThinnedTrack, KeepsItsSpacingAndTheNewestPoint) {
  DisplayTrack track(1.0, 100);
  for (int i = 0; i <= 105; ++i) {
    track.add(pointAt(0.1 * i));
  }
  const auto& points = track.points();
  ASSERT_EQ(points.size(), 12U);
  EXPECT_EQ(points.back().position_enu_m.x(), 0.1 * 105);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    EXPECT_NEAR(points[i].position_enu_m.x() - points[i - 1].position_enu_m.x(), 1.0, 0.11);
  }
}

TEST(ThinnedTrack, NeverOutgrowsItsCapacityAndKeepsTheWholeDrive) {
  DisplayTrack track(0.1, 64);
  for (int i = 0; i < 100000; ++i) {
    track.add(pointAt(0.1 * i));
    ASSERT_LE(track.points().size(), 64U);
  }
  EXPECT_EQ(track.points().front().position_enu_m.x(), 0.0);
  EXPECT_EQ(track.points().back().position_enu_m.x(), 0.1 * 99999);
  EXPECT_GT(track.points().size(), 16U);
  for (std::size_t i = 1; i < track.points().size(); ++i) {
    EXPECT_LE((track.points()[i].position_enu_m - track.points()[i - 1].position_enu_m).norm(), 2.1 * track.spacing());
  }
}

TEST(ThinnedTrack, AStandingRoverAddsNothing) {
  DisplayTrack track(0.1, 64);
  for (int i = 0; i < 1000; ++i) {
    track.add(pointAt(0.0, i));
  }
  ASSERT_EQ(track.points().size(), 2U);
  EXPECT_EQ(track.points().back().stamp, 999);
}

ImuSample imuAt(Nanoseconds stamp, double yaw_rate_radps) {
  ImuSample sample;
  sample.stamp = stamp;
  sample.omega_ib_b.z() = yaw_rate_radps;
  return sample;
}

/// Samples of 10 s at rest, then 20 s of driving with a turn, at 50 and 10 Hz.
template <class Sink>
void drive(Nanoseconds origin, Sink& sink) {
  for (int i = 1; i <= 1500; ++i) {
    const Nanoseconds stamp = origin + i * kSecond / 50;
    const bool moving = i > 500;
    sink(imuAt(stamp, moving ? 0.101 : 0.001));
    if (i % 5 == 0) {
      sink(SpeedSample{stamp, moving ? 0.8 : 0.0});
    }
  }
}

PlanarTrack everythingAtOnce(const PlanarSample& start) {
  PlanarDeadReckoning reckoning;
  reckoning.start(start);
  const auto add = [&reckoning](const auto& sample) {
    if constexpr (std::is_same_v<std::decay_t<decltype(sample)>, ImuSample>) {
      reckoning.addImu(sample);
    } else {
      reckoning.addSpeed(sample);
    }
  };
  drive(0, add);
  return reckoning.track();
}

TEST(WheelPath, EqualsDeadReckoningThatKnewItsStartAllAlong) {
  const PlanarSample start{15 * kSecond, 3.0, 4.0, 0.5};
  WheelPath path;
  const auto add = [&path](const auto& sample) { path.add(sample); };
  drive(0, add);
  EXPECT_TRUE(path.take().empty());
  path.start(start);
  const PlanarTrack track = path.take();
  const PlanarTrack expected = everythingAtOnce(start);
  ASSERT_FALSE(track.empty());
  EXPECT_GE(track.back().stamp, 29 * kSecond);
  const auto same = std::find_if(expected.begin(), expected.end(),
                                 [&track](const PlanarSample& pose) { return pose.stamp == track.back().stamp; });
  ASSERT_NE(same, expected.end());
  EXPECT_EQ(track.back().east_m, same->east_m);
  EXPECT_EQ(track.back().north_m, same->north_m);
  EXPECT_EQ(track.back().heading_rad, same->heading_rad);
}

TEST(WheelPath, HandsOutEachPoseOnceAndGoesOn) {
  WheelPath path;
  path.start({0, 0.0, 0.0, 0.0});
  Nanoseconds last = -1;
  std::size_t poses = 0;
  const auto add = [&](const auto& sample) {
    path.add(sample);
    for (const PlanarSample& pose : path.take()) {
      ASSERT_GE(pose.stamp, last);  // the newest one comes again
      poses += pose.stamp > last ? 1 : 0;
      last = pose.stamp;
    }
  };
  drive(0, add);
  EXPECT_EQ(poses, everythingAtOnce({0, 0.0, 0.0, 0.0}).size() - 1);  // the newest speed waits for the next one
}

TEST(WheelPath, BeginsAnewWhenTheClockGoesBack) {
  WheelPath path;
  path.start({0, 0.0, 0.0, 0.0});
  const auto add = [&path](const auto& sample) { path.add(sample); };
  drive(100 * kSecond, add);
  drive(0, add);
  EXPECT_FALSE(path.started());
  path.start({10 * kSecond, 7.0, 0.0, 0.0});
  const PlanarTrack track = path.take();
  EXPECT_EQ(track.front().east_m, 7.0);
  EXPECT_GT(track.size(), 150U);
}

TEST(StopLog, SaysHowLongAndWhatBecameOfTheError) {
  StopLog log(10);
  const Vector3 here(1.0, 2.0, 3.0);
  log.add(0, true, here, {0.0, 0.0});  // before the drive
  log.add(1 * kSecond, false, here, {0.2, 0.5});
  for (int i = 0; i <= 30; ++i) {
    log.add(2 * kSecond + i * kSecond / 10, true, here, {0.2 - 0.005 * i, 0.4});
  }
  log.add(6 * kSecond, false, here, {0.3, 0.5});
  ASSERT_EQ(log.stops().size(), 1U);
  const LoggedStop& stop = log.stops().front();
  EXPECT_EQ(stop.number, 1);
  EXPECT_NEAR(stop.duration_s, 3.0, 1e-9);
  EXPECT_EQ(stop.position_enu_m, here);
  EXPECT_DOUBLE_EQ(*stop.before.true_m, 0.2);
  EXPECT_DOUBLE_EQ(*stop.after.true_m, 0.05);
  EXPECT_EQ(stop.before.bound_m, 0.5);
}

TEST(StopLog, AMomentIsNoStop) {
  StopLog log(10);
  log.add(0, false, Vector3::Zero(), {});
  log.add(1 * kSecond, true, Vector3::Zero(), {});
  log.add(1 * kSecond + kSecond / 5, true, Vector3::Zero(), {});
  log.add(2 * kSecond, false, Vector3::Zero(), {});
  EXPECT_TRUE(log.stops().empty());
}

TEST(StopLog, ForgetsTheOldestBeyondItsCapacityAndGoesOnCounting) {
  for (const std::size_t capacity : {std::size_t{0}, std::size_t{3}}) {
    StopLog log(capacity);
    for (int i = 0; i < 10; ++i) {
      log.add(10 * i * kSecond, false, Vector3::Zero(), {});
      log.add((10 * i + 1) * kSecond, true, Vector3::Zero(), {});
      log.add((10 * i + 3) * kSecond, true, Vector3::Zero(), {});
    }
    ASSERT_EQ(log.stops().size(), capacity);
    if (capacity > 0) {
      EXPECT_EQ(log.stops().back().number, 10);
    }
  }
}

}  // namespace
}  // namespace slipnav
