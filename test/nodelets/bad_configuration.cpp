/// A nodelet with a wrong configuration says in one line what is wrong and stays idle; its manager lives on.

#include <gtest/gtest.h>
#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <string>
#include <vector>

namespace slipnav {
namespace {

class BadConfiguration : public ::testing::Test {
 protected:
  void SetUp() override {
    log_ = node_.subscribe<rosgraph_msgs::Log>(
        "/rosout", 100,
        boost::function<void(const rosgraph_msgs::LogConstPtr&)>([this](const rosgraph_msgs::LogConstPtr& message) {
          if (message->level == rosgraph_msgs::Log::ERROR) {
            errors_.push_back(message->msg);
          }
        }));
    ASSERT_TRUE(ros::service::waitForService("/manager/load_nodelet", ros::Duration(20.0)));
    ASSERT_TRUE(spinUntil([this] { return log_.getNumPublishers() > 1; }));  // the manager, and this node
  }

  /// @return whether it became true within some seconds
  template <class Condition>
  static bool spinUntil(Condition condition) {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    while (!condition() && (ros::SteadyTime::now() - begin).toSec() < 10.0) {
      ros::spinOnce();
      ros::WallDuration(0.02).sleep();
    }
    return condition();
  }

  static void load(const std::string& name, const std::string& type) {
    nodelet::NodeletLoad load;
    load.request.name = name;
    load.request.type = type;
    EXPECT_TRUE(ros::service::call("/manager/load_nodelet", load));
  }

  static bool isPublished(const std::string& topic) {
    ros::master::V_TopicInfo topics;
    ros::master::getTopics(topics);
    return std::any_of(topics.begin(), topics.end(),
                       [&topic](const ros::master::TopicInfo& info) { return info.name == topic; });
  }

  void expectOneError(const std::string& text) {
    EXPECT_TRUE(spinUntil([this] { return !errors_.empty(); }));
    ASSERT_EQ(errors_.size(), 1U);
    EXPECT_EQ(errors_.front(), text);
  }

  ros::NodeHandle node_;
  ros::Subscriber log_;
  std::vector<std::string> errors_;
};

TEST_F(BadConfiguration, NamesAnUnknownKeyAndTheNearestKnownOne) {
  node_.setParam("/misspelt/slipnav/imu/nosie/gyro_noise_deg_per_sqrt_h", 0.1);
  load("/misspelt/ins", "slipnav/Ins");
  expectOneError(
      "/misspelt/ins stays idle: parameters /misspelt/slipnav: unknown key 'imu.nosie', did you mean 'imu.noise'?");
  EXPECT_FALSE(isPublished("/misspelt/ins_steps"));
}

TEST_F(BadConfiguration, NamesAValueOutOfRange) {
  node_.setParam("/negative/slipnav/filter/gate_alpha", -1.0);
  load("/negative/filter", "slipnav/Filter");
  expectOneError(
      "/negative/filter stays idle: parameters /negative/slipnav: 'filter.gate_alpha' must be 1e-12 to 0.5, not -1");
}

TEST_F(BadConfiguration, LeavesTheManagerAndGoodNodeletsAlone) {
  node_.setParam("/truth/slipnav/initialization/source", "truth");
  load("/truth/initializer", "slipnav/Initializer");
  expectOneError("/truth/initializer stays idle: initialization.source: truth is for the evaluator only");
  load("/good/initializer", "slipnav/Initializer");
  EXPECT_TRUE(isPublished("/good/initial_state"));
  for (const char* name : {"/good/initializer/initialize", "/good/initializer/initialise"}) {  // now and formerly
    std_srvs::Trigger search;
    EXPECT_TRUE(ros::service::call(name, search)) << name;
    EXPECT_NE(search.response.success, 0) << name;
  }
  nodelet::NodeletList list;
  EXPECT_TRUE(ros::service::call("/manager/list", list));
  EXPECT_EQ(errors_.size(), 1U);
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "bad_configuration");
  return RUN_ALL_TESTS();
}
