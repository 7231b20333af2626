/// The reader of recordings beside rosbag's own, and recordings with wrong lengths, places and types.

#include "ros/bag/bag_file.h"

#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "ros/bag/bag_evaluation.h"
#include "ros/messages/conversions.h"
#include "ros/simulated_bag.h"
#include "support/sample_parameters.h"

namespace slipnav {
namespace {

using test::messageOf;
using test::TemporaryBag;

constexpr int kMessages = 40;

/// Two topics, several chunks, not in the order of time.
void writeSample(const std::string& path, rosbag::CompressionType compression) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  bag.setCompression(compression);
  bag.setChunkThreshold(2000);
  for (int i = 0; i < kMessages; ++i) {
    sensor_msgs::JointState joints;
    joints.name = {"left", "right"};
    joints.velocity = {1.0 * i, 2.0 * i};
    bag.write("/joint_states", ros::Time(100 + (i ^ 1)), joints);
    sensor_msgs::Imu imu;
    imu.angular_velocity.z = i;
    bag.write("/imu/data", ros::Time(100.5 + i), imu);
  }
}

class BagFileTest : public ::testing::Test {
 protected:
  std::string bytes() const {
    std::ifstream file(bag_.path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  /// Where the bytes after the first `text` are.
  std::size_t placeAfter(const std::string& text) const { return bytes().find(text) + text.size(); }

  void overwrite(std::size_t place, std::uint32_t number) const {
    std::fstream file(bag_.path(), std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(place));
    file.write(reinterpret_cast<const char*>(&number), sizeof number);
  }

  /// Reads everything; the error without the name of the file.
  std::string complaint() const {
    const std::string message = messageOf<std::invalid_argument>([this] {
      BagFile file(bag_.path());
      for (const BagEntry& entry : file.entries()) {
        file.holds<sensor_msgs::Imu>(entry) ? static_cast<void>(file.read<sensor_msgs::Imu>(entry))
                                            : static_cast<void>(file.read<sensor_msgs::JointState>(entry));
      }
    });
    EXPECT_EQ(message.find(bag_.path() + ": "), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message.substr(std::min(message.size(), bag_.path().size() + 2));
  }

  TemporaryBag bag_;
};

class BagFileCompressionTest : public BagFileTest, public ::testing::WithParamInterface<rosbag::CompressionType> {};

TEST_P(BagFileCompressionTest, ReadsWhatRosbagReads) {
  writeSample(bag_.path(), GetParam());
  BagFile file(bag_.path());
  const rosbag::Bag bag(bag_.path());
  rosbag::View view(bag);
  ASSERT_EQ(file.entries().size(), view.size());
  auto entry = file.entries().begin();
  for (const rosbag::MessageInstance& instance : view) {
    ASSERT_EQ(entry->time, toNanoseconds(instance.getTime()));
    ASSERT_EQ(file.connection(*entry).topic, instance.getTopic());
    ASSERT_EQ(file.connection(*entry).type, instance.getDataType());
    if (const auto imu = instance.instantiate<sensor_msgs::Imu>()) {
      ASSERT_EQ(file.read<sensor_msgs::Imu>(*entry).angular_velocity.z, imu->angular_velocity.z);
    } else {
      ASSERT_EQ(file.read<sensor_msgs::JointState>(*entry).velocity,
                instance.instantiate<sensor_msgs::JointState>()->velocity);
    }
    ++entry;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, BagFileCompressionTest,
                         ::testing::Values(rosbag::compression::Uncompressed, rosbag::compression::LZ4,
                                           rosbag::compression::BZ2));

TEST_F(BagFileTest, RefusesARecordThatClaimsToBeLargerThanTheFile) {
  writeSample(bag_.path(), rosbag::compression::Uncompressed);
  overwrite(13, 0xfffffff0);
  EXPECT_EQ(complaint(), "is not a complete bag: a record at byte 17 claims to have 4294967280 bytes, the file has " +
                             std::to_string(bytes().size()));
}

TEST_F(BagFileTest, RefusesAChunkThatClaimsToHoldMoreThanItCan) {
  writeSample(bag_.path(), rosbag::compression::LZ4);
  overwrite(placeAfter("size="), 0xfffffff0);
  EXPECT_NE(complaint().find("bytes claims to hold 4294967280"), std::string::npos);
}

TEST_F(BagFileTest, RefusesAMessageThatLiesBeyondItsChunk) {
  writeSample(bag_.path(), rosbag::compression::Uncompressed);
  overwrite(placeAfter(std::string("op=\x04\x08\0\0\0ver=\x01\0\0\0", 16)) + 12, 0x7ffffff0);
  EXPECT_NE(complaint().find("claims to have 2147483632 bytes more where there are"), std::string::npos);
}

TEST_F(BagFileTest, RefusesAMessageThatClaimsToBeLongerThanItsChunk) {
  writeSample(bag_.path(), rosbag::compression::Uncompressed);
  overwrite(placeAfter(std::string("op=\x02\x0d\0\0\0time=", 12)) + 8, 0x00ffffff);
  EXPECT_NE(complaint().find("is damaged: a message of topic '/joint_states': a record claims to have"),
            std::string::npos);
}

TEST_F(BagFileTest, RefusesAMessageThatEndsInItsContent) {
  writeSample(bag_.path(), rosbag::compression::Uncompressed);
  overwrite(placeAfter(std::string("op=\x02\x0d\0\0\0time=", 12)) + 8, 20);
  EXPECT_NE(complaint().find("is damaged: a message of topic '/joint_states': "), std::string::npos);
}

TEST_F(BagFileTest, RefusesAnIndexOfATopicThatIsNotThere) {
  writeSample(bag_.path(), rosbag::compression::Uncompressed);
  const std::string all = bytes();
  overwrite(all.rfind("conn=", all.find("op=\x04")) + 5, 99);
  EXPECT_EQ(complaint(), "is not a complete bag: its index names a topic that it does not have");
}

template <class Message>
boost::shared_ptr<ros::M_string> headerOf() {
  auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = ros::message_traits::datatype<Message>();
  (*header)["md5sum"] = ros::message_traits::md5sum<Message>();
  (*header)["message_definition"] = ros::message_traits::definition<Message>();
  return header;
}

/// As if another node took over the topic during the recording.
TEST_F(BagFileTest, NamesATopicWithMessagesOfTwoTypes) {
  {
    rosbag::Bag bag(bag_.path(), rosbag::bagmode::Write);
    bag.write("/imu/data", ros::Time(10), nav_msgs::Odometry(), headerOf<nav_msgs::Odometry>());
    bag.write("/imu/data", ros::Time(11), sensor_msgs::Imu(), headerOf<sensor_msgs::Imu>());
    bag.write("/joint_states", ros::Time(12), sensor_msgs::JointState());
  }
  Config config;
  config.initialization.source = "given";
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { evaluateBag(bag_.path(), config, "", {}); }),
            bag_.path() + ": topic '/imu/data' is not of the sensor_msgs/Imu known here");
}

}  // namespace
}  // namespace slipnav
