/// The command check on recordings: a simulated drive, the same corrupted, parts, and files that are not recordings.

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <filesystem>
#include <fstream>

#include "core/base/atomic_file.h"
#include "inspection/configuration_proposal.h"
#include "inspection/inspection.h"
#include "ros/bag/bag_evaluation.h"
#include "ros/bag/bag_inspection.h"
#include "ros/simulated_bag.h"
#include "support/sample_parameters.h"

namespace slipnav {
namespace {

const std::string& simulatedDrive() {
  static const test::TemporaryBag bag;
  static const bool written = [] {
    test::writeShortDrive(bag.path(), Config());
    return true;
  }();
  EXPECT_TRUE(written);
  return bag.path();
}

std::string textOf(const Recording& recording) { return toText(inspect(recording, {}).findings); }

template <class Message>
std::string textOfEdited(const std::string& topic, const std::function<void(Message&)>& edit) {
  const test::TemporaryBag edited;
  test::editBag(simulatedDrive(), edited.path(), [&](const rosbag::MessageInstance& instance, rosbag::Bag& target) {
    if (instance.getTopic() == topic || instance.getTopic() == "/" + topic) {
      Message message = *instance.instantiate<Message>();
      edit(message);
      target.write(instance.getTopic(), instance.getTime(), message);
    } else {
      target.write(instance.getTopic(), instance.getTime(), instance);
    }
  });
  return textOf(readRecording({edited.path()}));
}

TEST(BagInspection, FindsASimulatedDriveUsable) {
  const Recording recording = readRecording({simulatedDrive()});
  const Inspection inspection = inspect(recording, {});
  EXPECT_NE(statusOf(inspection.findings), 2) << toText(inspection.findings);
  EXPECT_TRUE(inspection.mounting.nearest.isIdentity());
  EXPECT_NE(topicTable(recording, inspection.roles).find("= imu/data"), std::string::npos);
}

TEST(BagInspection, TheProposedConfigurationRuns) {
  const Recording recording = readRecording({simulatedDrive()});
  InspectionOptions options;
  options.wheel_radius_m = 0.11;
  const test::TemporaryBag yaml;  // any temporary file
  AtomicFile file(yaml.path());
  file.stream() << proposedYaml(inspect(recording, options), options, "drive.bag");
  file.commit();
  const BagEvaluation evaluation = evaluateBag(simulatedDrive(), Config::load({yaml.path()}), "", {});
  EXPECT_LT(evaluation.report.metrics.enu_error_pct.value_or(100.0), 10.0);
}

TEST(BagInspection, NamesWhatIsWrongWithADamagedDrive) {
  EXPECT_NE(textOfEdited<sensor_msgs::Imu>("imu/data",
                                           [](sensor_msgs::Imu& imu) {
                                             imu.linear_acceleration.x /= 9.80665;
                                             imu.linear_acceleration.y /= 9.80665;
                                             imu.linear_acceleration.z /= 9.80665;
                                           })
                .find("in g?"),
            std::string::npos);
  EXPECT_NE(textOfEdited<sensor_msgs::Imu>("imu/data",
                                           [](sensor_msgs::Imu& imu) { imu.linear_acceleration_covariance[0] = -1.0; })
                .find("covariance[0] is -1"),
            std::string::npos);
  EXPECT_NE(textOfEdited<sensor_msgs::JointState>(
                "joint_states", [](sensor_msgs::JointState& joints) { joints.header.stamp = ros::Time(0, 0); })
                .find("are zero"),
            std::string::npos);
}

TEST(BagInspection, PartsAreReadTogetherInWhateverOrder) {
  const test::TemporaryBag first;
  const test::TemporaryBag second;
  const Recording whole = readRecording({simulatedDrive()});
  const Nanoseconds middle = (whole.begin + whole.end) / 2;
  const auto keep = [middle](bool early) {
    return [middle, early](const rosbag::MessageInstance& instance, rosbag::Bag& target) {
      if ((static_cast<Nanoseconds>(instance.getTime().toNSec()) < middle) == early) {
        target.write(instance.getTopic(), instance.getTime(), instance);
      }
    };
  };
  test::editBag(simulatedDrive(), first.path(), keep(true));
  test::editBag(simulatedDrive(), second.path(), keep(false));
  const Recording joined = readRecording({second.path(), first.path()});
  ASSERT_EQ(joined.imus.size(), 1U);
  EXPECT_EQ(joined.imus[0].samples.size(), whole.imus.at(0).samples.size());
  EXPECT_EQ(joined.imus[0].samples.front().time.stamp, whole.imus[0].samples.front().time.stamp);
  EXPECT_EQ(textOf(joined), textOf(whole));
}

TEST(BagInspection, FindsThePoseOfTheImuInTransforms) {
  const test::TemporaryBag with_tf;
  test::editBag(simulatedDrive(), with_tf.path(), [](const rosbag::MessageInstance& instance, rosbag::Bag& target) {
    static bool done = false;
    if (!done) {
      done = true;
      tf2_msgs::TFMessage tf;
      tf.transforms.resize(1);
      tf.transforms[0].header.frame_id = "base_link";
      tf.transforms[0].child_frame_id = "imu_link";
      tf.transforms[0].transform.translation.x = 0.25;
      tf.transforms[0].transform.rotation.w = 1.0;
      target.write("/tf", instance.getTime(), tf);
    }
    target.write(instance.getTopic(), instance.getTime(), instance);
  });
  const Recording recording = readRecording({with_tf.path()});
  const auto pose = poseByTransforms(recording, "base_link", "imu_link");
  ASSERT_TRUE(pose);
  EXPECT_DOUBLE_EQ(pose->x_m, 0.25);
  EXPECT_FALSE(poseByTransforms(recording, "base_link", "camera"));
}

TEST(BagInspection, FilesThatAreNoRecordingsAreNamed) {
  EXPECT_THROW(readRecording({"/nonexistent.bag"}), std::invalid_argument);
  const test::TemporaryBag ros2;
  std::ofstream(ros2.path(), std::ios::binary) << "SQLite format 3" << std::string(100, '\0');
  try {
    readRecording({ros2.path()});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("recording of ROS 2"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("rosbags-convert"), std::string::npos);
  }
}

TEST(BagInspection, NamesRowsOfASolutionThatHoldNone) {
  const std::string path = ::testing::TempDir() + "slipnav_unsolved.pos";
  std::ofstream(path) << "% (lat/lon/height=WGS84/ellipsoidal,Q=1:fix)\n"
                         "%  UTC latitude(deg) longitude(deg) height(m) Q ns sdn(m) sde(m) sdu(m) sdne(m) sdeu(m) "
                         "sdun(m) age(s) ratio\n"
                         "2026/01/01 00:00:00.000 39.7 -79.9 250.0 1 9 0.01 0.01 0.02 0 0 0 0 9\n"
                         "2026/01/01 00:00:00.100 39.7 -79.9 250.0 0 9 0.01 0.01 0.02 0 0 0 0 9\n"
                         "2026/01/01 00:00:00.200 39.7 -79.9 250.0 1 9 0.01 0.01 0.02 0 0 0 0 9\n";
  Recording recording = readRecording({simulatedDrive()});
  addRtklibFile(path, recording);
  EXPECT_EQ(recording.fixes.back().samples.size(), 2U);
  InspectionOptions options;
  options.truth = path;
  const std::string found = toText(inspect(recording, options).findings);
  EXPECT_NE(found.find("1 row of quality 0, without a solution"), std::string::npos) << found;
}

TEST(BagInspection, FoldersAreNoRecordings) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "slipnav_ros2_drive";
  std::filesystem::create_directory(folder);
  EXPECT_EQ(test::messageOf<std::invalid_argument>([&folder] { readRecording({folder}); }),
            folder.string() + ": is a folder; name the recordings in it");
  std::ofstream(folder / "metadata.yaml") << "rosbag2_bagfile_information:\n  storage_identifier: mcap\n";
  const std::string command = "rosbags-convert --src " + folder.string() + "/ --dst slipnav_ros2_drive.bag ";
  EXPECT_NE(test::messageOf<std::invalid_argument>([&folder] { readRecording({folder.string() + "/"}); }).find(command),
            std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace slipnav
