/// What the overlay publishes for a given picture.

#include "ros/rviz/overlay_markers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cmath>

#include "overlay/palette.h"
#include "ros/rviz/model_joints.h"

namespace slipnav {
namespace {

using visualization_msgs::Marker;

class OverlayMessagesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    picture_.start(LocalFrame(Planet::byName("earth"), {0.7, -1.4, 300.0}), fromSeconds(1.0));
    for (int i = 50; i <= 1000; ++i) {  // east at 1 m/s, standing at 10 m from t = 11 s on
      EstimateSample estimate;
      estimate.stamp = fromSeconds(0.02 * i);
      estimate.position_enu_m.x() = std::min(0.02 * i, 10.0);
      estimate.speed_mps = estimate.position_enu_m.x() < 10.0 ? 1.0 : 0.0;
      estimate.covariance_enu_m2 = Matrix3::Identity() * 0.04;
      picture_.add(estimate);
      picture_.addSlip(estimate.stamp, 0.15, estimate.speed_mps == 0.0);
    }
  }

  void forecast(double threshold_m, double age_s = 0.0) {
    const auto message = boost::make_shared<ErrorForecast>();
    message->header.stamp.fromSec(20.0 - age_s);
    message->times_s = {10.0, 20.0, 30.0};
    message->horizontal_bound_m = {0.5, 1.0, 2.0};
    message->threshold_m = threshold_m;
    message->time_to_stop_s = threshold_m <= 2.0 ? 30.0 : std::numeric_limits<double>::infinity();
    messages_.error_forecast = message;
  }

  std::vector<Marker> all() { return maker_.make(picture_, messages_).markers; }

  static const Marker* find(const std::vector<Marker>& markers, const std::string& name, int id = 0) {
    const auto found = std::find_if(markers.begin(), markers.end(), [&](const Marker& marker) {
      return marker.ns == name && marker.id == id && marker.action == Marker::ADD;
    });
    return found == markers.end() ? nullptr : &*found;
  }

  OverlayParams params_;
  DriveView picture_{params_, {}, Vector3::Zero()};
  OverlayMessages messages_;
  OverlayMarkers maker_{params_, "map"};
};

TEST_F(OverlayMessagesTest, EveryMarkerIsOfItsFrameAndValid) {
  forecast(2.0);
  for (const Marker& marker : all()) {
    const bool beside_rover = marker.ns == "legend";
    EXPECT_EQ(marker.header.frame_id, beside_rover ? params_.frame : "map");
    EXPECT_EQ(static_cast<bool>(marker.frame_locked), beside_rover);
    EXPECT_EQ(marker.header.stamp.toSec(), 20.0);
    EXPECT_EQ(marker.pose.orientation.w, 1.0);
    const bool stays = beside_rover || marker.ns == "slip" || marker.ns == "stops" || marker.ns == "stop labels";
    EXPECT_EQ(marker.lifetime.isZero(), stays) << marker.ns;
    EXPECT_TRUE(marker.colors.empty() || marker.colors.size() == marker.points.size()) << marker.ns;
    EXPECT_TRUE(marker.type != Marker::TRIANGLE_LIST || marker.points.size() % 3 == 0);
  }
}

TEST_F(OverlayMessagesTest, TheTrackHasTheColorOfItsSlip) {
  const auto markers = all();
  const Marker* slip = find(markers, "slip");
  ASSERT_NE(slip, nullptr);
  EXPECT_EQ(slip->points.size(), picture_.track().points().size());
  const Color expected = slipColor(0.15, params_.slip_full_scale);
  EXPECT_FLOAT_EQ(slip->colors.back().r, expected.red);
  EXPECT_FLOAT_EQ(slip->colors.back().b, expected.blue);
}

TEST_F(OverlayMessagesTest, TheFanTurnsColorAsItNearsTheThreshold) {
  forecast(2.0);
  const auto markers = all();
  const Marker* fan = find(markers, "forecast");
  ASSERT_NE(fan, nullptr);
  EXPECT_EQ(fan->points.size(), 12U);
  const auto furthest =
      std::max_element(fan->points.begin(), fan->points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  const auto& color = fan->colors[static_cast<std::size_t>(furthest - fan->points.begin())];
  EXPECT_FLOAT_EQ(color.r, kLimitColor.red);
  EXPECT_FLOAT_EQ(color.g, kLimitColor.green);
  EXPECT_NEAR(furthest->x, 40.0, 0.5);
  EXPECT_NEAR(std::abs(furthest->y), 2.0, 0.01);
  ASSERT_NE(find(markers, "stop ahead"), nullptr);
  EXPECT_EQ(find(markers, "stop ahead", 1), nullptr) << "one countdown is enough, that of the supervisor";
}

TEST_F(OverlayMessagesTest, NoStopIsAheadWhereTheThresholdIsFar) {
  forecast(5.0);
  EXPECT_EQ(find(all(), "stop ahead"), nullptr);
}

TEST_F(OverlayMessagesTest, WhatIsGoneIsDeletedOnce) {
  forecast(2.0);
  ASSERT_NE(find(all(), "forecast"), nullptr);
  forecast(2.0, 15.0);  // an old one
  auto markers = all();
  EXPECT_EQ(find(markers, "forecast"), nullptr);
  const auto deletions = [](const std::vector<Marker>& list) {
    return std::count_if(list.begin(), list.end(), [](const Marker& m) { return m.action == Marker::DELETE; });
  };
  EXPECT_EQ(deletions(markers), 3);  // fan, horizon, stop ahead
  EXPECT_EQ(deletions(all()), 0);
  picture_.clear();
  markers = all();
  EXPECT_EQ(deletions(markers), static_cast<long>(markers.size()));
}

TEST_F(OverlayMessagesTest, EachStopIsMarked) {
  const auto markers = all();
  ASSERT_NE(find(markers, "stops", 1), nullptr);
  EXPECT_NEAR(find(markers, "stops", 1)->pose.position.x, 10.0, 1e-6);
  ASSERT_NE(find(markers, "stop labels", 1), nullptr);
  EXPECT_NE(find(markers, "stop labels", 1)->text.find("3 sigma 0.60 > 0.60 m"), std::string::npos)
      << find(markers, "stop labels", 1)->text;
}

TEST_F(OverlayMessagesTest, WithoutEstimatesNothingOfNowIsDrawn) {
  forecast(2.0);
  ASSERT_NE(find(all(), "ellipse"), nullptr);
  messages_.stale = true;
  const auto markers = all();
  for (const char* name : {"forecast", "horizon", "stop ahead", "ellipse", "error"}) {
    EXPECT_EQ(find(markers, name), nullptr) << name;
  }
  EXPECT_NE(find(markers, "slip"), nullptr) << "where it has been is still true";
}

TEST_F(OverlayMessagesTest, FiguresAreALine) { EXPECT_EQ(figuresOf(picture_), "distance 9.0 m    3σ 0.60 m"); }

TEST_F(OverlayMessagesTest, PathsHoldTheirPoints) {
  const nav_msgs::Path path = toPath(picture_.track(), "map");
  EXPECT_EQ(path.header.frame_id, "map");
  ASSERT_EQ(path.poses.size(), picture_.track().points().size());
  EXPECT_EQ(path.poses.back().pose.position.x, 10.0);
  EXPECT_EQ(path.poses.back().header.stamp.toSec(), 20.0);
  EXPECT_TRUE(toPath(picture_.truth(), "map").poses.empty());
}

TEST(ModelJoints, TurnAsTheWheelsDo) {
  ModelJoints joints;
  for (int i = 0; i <= 10; ++i) {
    WheelMotion wheels;
    wheels.stamp = fromSeconds(100.0 + 0.1 * i);
    wheels.count = 4;
    wheels.circumferential_mps = {0.11, 0.22, 0.0, -0.11};
    joints.add(wheels);
  }
  const sensor_msgs::JointState message = joints.message();
  EXPECT_EQ(message.name[1], "front_right_wheel");
  EXPECT_NEAR(message.position[0], 1.0, 1e-9);
  EXPECT_NEAR(message.position[1], 2.0, 1e-9);
  EXPECT_NEAR(message.position[2], 0.0, 1e-9);
  EXPECT_NEAR(message.position[3], -1.0, 1e-9);
}

TEST(ModelJoints, TurnWithTheSpeedWhereWheelsAreNotKnownOneByOne) {
  ModelJoints joints;
  for (int i = 0; i <= 10; ++i) {
    WheelMotion wheels;
    wheels.stamp = fromSeconds(100.0 + 0.1 * i);
    wheels.motion.forward_mps = 0.11;
    joints.add(wheels);
  }
  for (const double angle_rad : joints.message().position) {
    EXPECT_NEAR(angle_rad, 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace slipnav
