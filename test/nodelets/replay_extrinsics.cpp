/// Poses of the sensors from TF: the recording's own /tf_static reaches nodelets and offline run alike.

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include "replay_fixture.h"

namespace slipnav {
namespace {

class ReplayExtrinsics : public test::ReplayFixture {};

geometry_msgs::TransformStamped pose(const std::string& child, double x_m, double z_m) {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "base_link";
  transform.child_frame_id = child;
  transform.transform.translation.x = x_m;
  transform.transform.translation.z = z_m;
  transform.transform.rotation.w = 1.0;
  return transform;
}

TEST_F(ReplayExtrinsics, ComeFromTheRecording) {
  ASSERT_TRUE(config_->frames.extrinsicsFromTf());
  test::TemporaryBag with_tf;
  test::editBag(bag_->path(), with_tf.path(), [](const rosbag::MessageInstance& instance, rosbag::Bag& target) {
    target.write(instance.getTopic(), instance.getTime(), instance);
  });
  rosbag::Bag bag(with_tf.path(), rosbag::bagmode::Append);
  tf2_msgs::TFMessage transforms;
  transforms.transforms = {pose("imu_link", 0.2, 0.1), pose("gps", -0.1, 0.4)};
  bag.write("/tf_static", ros::Time(config_->simulator.start_time_s + 3.0), transforms);
  bag.close();

  const BagEvaluation from_tf = replayAndCompare(with_tf.path(), 20.0);

  Config parameters = *config_;
  parameters.frames.extrinsics = "parameters";
  const BagEvaluation at_base = evaluateBag(bag_->path(), parameters, "", {});
  parameters.imu.mount.x_m = 0.2;
  parameters.imu.mount.z_m = 0.1;
  parameters.gps_mount.x_m = -0.1;
  parameters.gps_mount.z_m = 0.4;
  const BagEvaluation from_parameters = evaluateBag(bag_->path(), parameters, "", {});
  expectEqual(from_tf.report.estimates, from_parameters.report.estimates);
  EXPECT_NE(from_tf.report.estimates.back().position_enu_m, at_base.report.estimates.back().position_enu_m);
}

TEST(Extrinsics, ARecordingWithoutThemIsRefused) {
  test::TemporaryBag bag;
  Config config;
  test::writeShortDrive(bag.path(), config);
  config.frames.extrinsics = "tf";
  try {
    BagReader(bag.path(), config);
    FAIL() << "was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(), bag.path() + ": no transform base_link → imu_link in /tf_static and /tf");
  }
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "replay_extrinsics");
  return RUN_ALL_TESTS();
}
