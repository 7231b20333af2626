/// Recordings: what is written comes back, and what cannot be used is named.

#include <gtest/gtest.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/NavSatFix.h>
#include <std_msgs/String.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "ros/bag/bag_evaluation.h"
#include "ros/bag/bag_reader.h"
#include "ros/simulated_bag.h"
#include "support/sample_parameters.h"

namespace slipnav {
namespace {

using test::messageOf;
using test::TemporaryBag;

struct Collected {
  std::vector<ImuSample> imu;
  std::vector<WheelMotion> wheels;
  std::vector<GnssFix> fixes;
  std::vector<VelocityFix> velocities;
  std::vector<GnssFix> truth_fixes;
  std::vector<TruthSample> truth_poses;
};

Collected readAll(const BagReader& reader) {
  Collected all;
  BagSink sink;
  sink.imu = [&all](const ImuSample& sample) { all.imu.push_back(sample); };
  sink.wheels = [&all](const WheelMotion& sample) { all.wheels.push_back(sample); };
  sink.fix = [&all](const GnssFix& sample) { all.fixes.push_back(sample); };
  sink.velocity = [&all](const VelocityFix& sample) { all.velocities.push_back(sample); };
  sink.truth_fix = [&all](const GnssFix& sample) { all.truth_fixes.push_back(sample); };
  sink.truth_pose = [&all](const TruthSample& sample) { all.truth_poses.push_back(sample); };
  sink.truth_start = [](const NavigationState&, bool) {};
  sink.problem = [](const std::string& problem, Nanoseconds) { FAIL() << problem; };
  reader.read(sink);
  return all;
}

class BagTest : public ::testing::Test {
 protected:
  std::string complaint(const Config& config = {}, const std::string& truth = "", const BagRange& range = {}) const {
    const std::string message = messageOf<std::invalid_argument>([&] { BagReader(bag_.path(), config, truth, range); });
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message;
  }

  TemporaryBag bag_;
};

TEST_F(BagTest, WhatTheSimulatorMeasuresComesBack) {
  Config config;
  config.wheels[1].sign = -1.0;
  config.imu.mount = {0.1, 0.2, 0.3, 90.0, 0.0, -90.0};
  test::writeShortDrive(bag_.path(), config);

  std::vector<ImuSample> imu;
  std::vector<WheelSample> wheels;
  sim::SimulatorParams params = config.simulator;
  params.drive.initial_rest_s = 8.0;
  params.drive.distance_m = 10.0;
  params.drive.final_rest_s = 2.0;
  PeriodicStops stops(5.0, 2.0);
  simulateDrive(params, Planet::byName("earth"), stops, [&](const sim::Measurements& m, const sim::TruthState&) {
    imu.push_back(m.imu);
    if (m.wheel) {
      wheels.push_back(*m.wheel);
    }
  });

  const Collected all = readAll(BagReader(bag_.path(), config));
  ASSERT_EQ(all.imu.size(), imu.size());
  for (std::size_t i = 0; i < imu.size(); ++i) {
    ASSERT_EQ(all.imu[i].stamp, imu[i].stamp);
    ASSERT_LT((all.imu[i].f_ib_b - imu[i].f_ib_b).norm(), 1e-12);
    ASSERT_LT((all.imu[i].omega_ib_b - imu[i].omega_ib_b).norm(), 1e-12);
  }
  ASSERT_EQ(all.wheels.size(), wheels.size());
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    ASSERT_EQ(all.wheels[i].stamp, wheels[i].stamp);
    ASSERT_EQ(all.wheels[i].circumferential_mps[1], config.wheels[1].radius_m * wheels[i].rate_radps[1]);
  }
  EXPECT_FALSE(all.fixes.empty());
  EXPECT_FALSE(all.truth_fixes.empty());
  EXPECT_TRUE(all.truth_poses.empty());
}

TEST_F(BagTest, TheTruthCanBeChosen) {
  test::writeShortDrive(bag_.path(), {});
  const BagReader poses(bag_.path(), {}, "truth/odometry");
  EXPECT_FALSE(poses.truthIsGeodetic());
  EXPECT_FALSE(readAll(poses).truth_poses.empty());
  EXPECT_TRUE(BagReader(bag_.path(), {}, "gps/fix").truthIsGeodetic());
  EXPECT_NE(complaint({}, "truth/nowhere").find("has no topic 'truth/nowhere' for the truth"), std::string::npos);
  EXPECT_NE(complaint({}, "joint_states").find("is of type sensor_msgs/JointState, which is not a truth type"),
            std::string::npos);
}

TEST_F(BagTest, APartCanBeRead) {
  test::writeShortDrive(bag_.path(), {});
  const Collected part = readAll(BagReader(bag_.path(), {}, "", {5.0, 2.0}));
  ASSERT_FALSE(part.imu.empty());
  EXPECT_NEAR(toSeconds(part.imu.back().stamp - part.imu.front().stamp), 2.0, 0.05);
  EXPECT_NE(complaint({}, "", {1000.0, 0.0}).find("is shorter than"), std::string::npos);
}

TEST_F(BagTest, PartsAreOneRecording) {
  test::writeShortDrive(bag_.path(), {});
  TemporaryBag first;
  TemporaryBag second;
  const Nanoseconds middle = BagReader(bag_.path(), {}).begin() + 20 * kSecond;
  const auto copyIf = [this, middle](const std::string& to, bool before) {
    test::editBag(bag_.path(), to, [middle, before](const rosbag::MessageInstance& message, rosbag::Bag& target) {
      if ((static_cast<Nanoseconds>(message.getTime().toNSec()) < middle) == before) {
        target.write(message.getTopic(), message.getTime(), message);
      }
    });
  };
  copyIf(first.path(), true);
  copyIf(second.path(), false);

  const BagReader whole(bag_.path(), {});
  const BagReader parts({second.path(), first.path()}, {}, "", {});
  EXPECT_EQ(parts.begin(), whole.begin());
  EXPECT_EQ(parts.duration(), whole.duration());
  const Collected expected = readAll(whole);
  const Collected all = readAll(parts);
  ASSERT_EQ(all.imu.size(), expected.imu.size());
  for (std::size_t i = 0; i < expected.imu.size(); ++i) {
    ASSERT_EQ(all.imu[i].stamp, expected.imu[i].stamp);
    ASSERT_EQ(all.imu[i].f_ib_b, expected.imu[i].f_ib_b);
  }
  EXPECT_EQ(all.wheels.size(), expected.wheels.size());
  EXPECT_EQ(all.fixes.size(), expected.fixes.size());
  EXPECT_EQ(all.truth_fixes.size(), expected.truth_fixes.size());
}

TEST_F(BagTest, FromTheTrueStartTheErrorIsSmall) {
  Config config;
  test::writeShortDrive(bag_.path(), config);
  config.initialization.source = "truth";
  const BagEvaluation evaluation = evaluateBag(bag_.path(), config, "truth/odometry", {});
  EXPECT_GT(evaluation.report.metrics.duration_s, 30.0);
  EXPECT_LT(evaluation.report.metrics.horizontal_max_m.value(), 1.0);
}

TEST_F(BagTest, NamesAFileThatCannotBeRead) {
  EXPECT_EQ(messageOf<std::invalid_argument>([] { BagReader("/nowhere.bag", {}); }), "/nowhere.bag: cannot be read");
}

TEST_F(BagTest, NamesAFileThatIsNoRecording) {
  std::ofstream(bag_.path()) << "some text";
  EXPECT_NE(complaint().find(bag_.path() + ": is not a complete bag: "), std::string::npos);
}

TEST_F(BagTest, NamesARecordingThatWasCutOff) {
  test::writeShortDrive(bag_.path(), {});
  std::filesystem::resize_file(bag_.path(), std::filesystem::file_size(bag_.path()) / 2);
  EXPECT_NE(complaint().find(bag_.path() + ": "), std::string::npos);
}

TEST_F(BagTest, NamesAnEmptyRecording) {
  rosbag::Bag(bag_.path(), rosbag::bagmode::Write).close();
  EXPECT_EQ(complaint(), bag_.path() + ": has no messages");
}

TEST_F(BagTest, NamesTheTopicThatIsMissing) {
  rosbag::Bag bag(bag_.path(), rosbag::bagmode::Write);
  bag.write("/imu/data", ros::Time(10), sensor_msgs::Imu());
  bag.close();
  EXPECT_EQ(complaint(), bag_.path() +
                             ": has neither topic 'joint_states' (sensor_msgs/JointState) nor 'wheel_odometry' "
                             "(nav_msgs/Odometry); it has imu/data");
  Config inertial;
  inertial.filter.updates.clear();
  EXPECT_NE(complaint(inertial).find("has no topic 'gps/fix' (sensor_msgs/NavSatFix), which initialization.source"),
            std::string::npos);
  inertial.topics.imu = "imu";
  EXPECT_EQ(complaint(inertial), bag_.path() + ": has no topic 'imu' (sensor_msgs/Imu); it has imu/data");
}

TEST_F(BagTest, NamesATopicOfTheWrongType) {
  rosbag::Bag bag(bag_.path(), rosbag::bagmode::Write);
  bag.write("imu/data", ros::Time(10), std_msgs::String());
  bag.close();
  EXPECT_EQ(complaint(), bag_.path() + ": topic 'imu/data' is of type std_msgs/String, not sensor_msgs/Imu");
}

TEST_F(BagTest, TheWriterWantsTheWheelsOfTheSimulatedRover) {
  Config config;
  config.wheels.pop_back();
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { BagWriter(bag_.path(), config); }),
            "wheels: the simulated rover has 4, not 3");
}

}  // namespace
}  // namespace slipnav
