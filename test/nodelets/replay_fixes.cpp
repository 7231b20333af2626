/// Satellites while driving: what the nodelets make of the fixes is what the offline run makes of them, to the last
/// bit.

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/NavSatFix.h>

#include "replay_fixture.h"

namespace slipnav {
namespace {

class ReplayFixes : public test::ReplayFixture {};

TEST_F(ReplayFixes, CorrectTheEstimateAsOffline) {
  const BagEvaluation always = replayAndCompare(bag_->path(), 20.0);
  Config start_only = *config_;
  start_only.gnss.use = "start";
  const BagEvaluation start = evaluateBag(bag_->path(), start_only, "", {});
  ASSERT_EQ(always.report.estimates.size(), start.report.estimates.size());
  EXPECT_NE(always.report.estimates.back().position_enu_m, start.report.estimates.back().position_enu_m);
}

/// As receivers are: a fix comes when it has been computed.
TEST_F(ReplayFixes, MayComeLateAndOneMayBeWrong) {
  test::TemporaryBag late;
  int fixes = 0;
  test::editBag(bag_->path(), late.path(),
                [&fixes, this](const rosbag::MessageInstance& instance, rosbag::Bag& target) {
                  const auto fix = instance.instantiate<sensor_msgs::NavSatFix>();
                  if (!fix || instance.getTopic() != "/" + config_->topics.gps_fix) {
                    target.write(instance.getTopic(), instance.getTime(), instance);
                    return;
                  }
                  sensor_msgs::NavSatFix edited = *fix;
                  edited.latitude += ++fixes % 7 == 0 ? 1e-3 : 0.0;
                  target.write(instance.getTopic(), instance.getTime() + ros::Duration(0.15), edited);
                });
  EXPECT_LT(replayAndCompare(late.path(), 20.0).report.metrics.horizontal_max_m.value(), 1.0);
  EXPECT_GT(fixes, 20);
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "replay_fixes");
  return RUN_ALL_TESTS();
}
