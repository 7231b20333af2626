/// Messages between nodelets of one process are the same objects on both sides: nothing is serialized or copied.
///
/// All nodelets of a drive run in this process beside the probes. Two listeners of one process alone would prove
/// nothing by equal addresses: of a message that came as bytes, roscpp makes one object and shares that. So the first
/// listener of each topic, from whose factory roscpp takes such an object, counts them; and roscpp is asked how many
/// bytes came over each link.

#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <nodelet/loader.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <slipnav/ErrorForecast.h>
#include <slipnav/FilterCorrection.h>
#include <slipnav/ForecastInput.h>
#include <slipnav/Initialization.h>
#include <slipnav/InsSteps.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>
#include <slipnav/SlipForecast.h>
#include <slipnav/StartState.h>
#include <slipnav/StopStatus.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Header.h>
#include <std_msgs/String.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "evaluation/simulated_drive.h"
#include "nodelets/own_links.h"
#include "ros/messages/conversions.h"
#include "ros/messages/simulated_sensors.h"
#include "ros/runtime/internal_topics.h"
#include "ros/runtime/parameters.h"
#include "ros/runtime/shared_publisher.h"

namespace slipnav::test {
namespace {

using Object = boost::shared_ptr<const void>;
using Objects = std::vector<Object>;

constexpr double kRate = 20.0;  // on real time
constexpr double kTimeout_s = 10.0;

// By value, a message would be serialized for every listener.
static_assert(!std::is_invocable_v<decltype(&SharedPublisher<Slip>::publish), SharedPublisher<Slip>, Slip>);

/// Serves the listeners of this test, all in its one thread, until `done` or for at most `timeout_s`.
template <class Done>
bool spinUntil(Done done, double timeout_s = kTimeout_s) {
  const ros::SteadyTime begin = ros::SteadyTime::now();
  while (!done() && (ros::SteadyTime::now() - begin).toSec() < timeout_s) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
  }
  return done();
}

/// Keeps the objects that it is given, so that no address comes twice.
struct Listener {
  Objects received;
  std::size_t made_of_bytes = 0;
  ros::Subscriber subscriber;
};

template <class Message>
std::unique_ptr<Listener> listen(ros::NodeHandle& node, const std::string& topic) {
  auto listener = std::make_unique<Listener>();
  Listener* const self = listener.get();
  ros::SubscribeOptions options;
  options.init<Message>(
      topic, 0, [self](const boost::shared_ptr<const Message>& message) { self->received.push_back(message); },
      [self] {
        ++self->made_of_bytes;
        return boost::make_shared<Message>();
      });
  self->subscriber = node.subscribe(options);
  return listener;
}

/// A topic with a listener from before the nodelets are loaded, and one from after that.
struct Probe {
  std::string topic;
  std::unique_ptr<Listener> (*subscribe)(ros::NodeHandle&, const std::string&);
  std::unique_ptr<Listener> first;
  std::unique_ptr<Listener> second;

  bool isEven() const { return !second->received.empty() && first->received.back() == second->received.back(); }
};

template <class Message>
Probe probe(const std::string& topic) {
  return {topic, &listen<Message>, nullptr, nullptr};
}

/// Every topic between the nodelets, and what they publish for others.
std::vector<Probe> probes(const TopicNames& topics) {
  std::vector<Probe> all;
  all.push_back(probe<sensor_msgs::Imu>(topics.imu));
  all.push_back(probe<sensor_msgs::JointState>(topics.joint_states));
  all.push_back(probe<sensor_msgs::NavSatFix>(topics.gps_fix));
  all.push_back(probe<geometry_msgs::TwistWithCovarianceStamped>(topics.gps_velocity));
  all.push_back(probe<sensor_msgs::NavSatFix>(topics.truth_fix));
  all.push_back(probe<geometry_msgs::Twist>(topics.cmd_vel_in));
  all.push_back(probe<StartState>(kInitialStateTopic));
  all.push_back(probe<Initialization>(kInitializationTopic));
  all.push_back(probe<InsSteps>(kInsStepsTopic));
  all.push_back(probe<FilterCorrection>(kCorrectionTopic));
  all.push_back(probe<StartState>(kHandOverTopic));
  all.push_back(probe<ForecastInput>(kForecastInputTopic));
  all.push_back(probe<std_msgs::Header>(kForecastProgressTopic));
  all.push_back(probe<nav_msgs::Odometry>(topics.odometry));
  all.push_back(probe<NavState>(topics.nav_state));
  all.push_back(probe<Slip>(topics.slip));
  all.push_back(probe<SlipForecast>(topics.slip_forecast));
  all.push_back(probe<ErrorForecast>(topics.error_forecast));
  all.push_back(probe<StopStatus>(topics.stop));
  all.push_back(probe<std_msgs::Float64>(topics.stop_cmd));
  all.push_back(probe<geometry_msgs::Twist>(topics.cmd_vel));
  all.push_back(probe<nav_msgs::Path>(topics.path));
  all.push_back(probe<nav_msgs::Path>(topics.truth_path));
  all.push_back(probe<nav_msgs::Path>(topics.wheel_path));
  all.push_back(probe<visualization_msgs::MarkerArray>(topics.markers));
  all.push_back(probe<sensor_msgs::JointState>(kModelJointsTopic));
  all.push_back(probe<std_msgs::String>(kFiguresTopic));
  return all;
}

/// Publishes and remembers what.
template <class Message>
class Source {
 public:
  Source(ros::NodeHandle& node, const std::string& topic) : publisher_(node, topic) {}

  void publish(Message message) {
    const auto object = boost::make_shared<const Message>(std::move(message));
    sent_.push_back(object);
    publisher_.publish(object);
  }
  const Objects& sent() const { return sent_; }

 private:
  SharedPublisher<Message> publisher_;
  Objects sent_;
};

class ZeroCopy : public ::testing::Test {
 protected:
  void load(const std::string& name, const std::string& type) {
    ASSERT_TRUE(loader_.load(name, type, nodelet::M_string(), nodelet::V_string()));
  }

  /// Publishes and waits until somebody else holds the very object.
  template <class Message>
  void expectHeld(const std::string& topic, const boost::shared_ptr<Message>& message) {
    ros::Publisher publisher = node_.advertise<Message>(topic, 1);
    ASSERT_TRUE(spinUntil([&publisher] { return publisher.getNumSubscribers() > 0; }));
    publisher.publish(boost::shared_ptr<const Message>(message));
    EXPECT_TRUE(spinUntil([&message] { return message.use_count() > 1; }));
    ros::WallDuration(0.5).sleep();  // what only sits in a queue is gone by now
    EXPECT_GT(message.use_count(), 1);
  }

  ros::NodeHandle node_;
  nodelet::Loader loader_{false};
};

TEST_F(ZeroCopy, FilterKeepsTheStepsThatOvertookTheirInitialState) {
  load("/filter", "slipnav/Filter");
  const auto steps = boost::make_shared<InsSteps>();
  steps->start = 1;
  steps->steps.resize(1);
  expectHeld(kInsStepsTopic, steps);
}

TEST_F(ZeroCopy, AListenerNoticesWhatIsPublishedByValue) {
  const std::string topic = "by_value";
  const std::unique_ptr<Listener> listener = listen<std_msgs::Header>(node_, topic);
  ros::Publisher publisher = node_.advertise<std_msgs::Header>(topic, 1);
  ASSERT_TRUE(spinUntil([&publisher] { return publisher.getNumSubscribers() > 0; }));
  publisher.publish(std_msgs::Header());
  ASSERT_TRUE(spinUntil([&listener] { return listener->received.size() == 1; }));
  EXPECT_EQ(listener->made_of_bytes, 1U);
  EXPECT_GT(traffic()[node_.resolveName(topic)].bytes, 0);
}

/// A drive through all nodelets, long enough for forecasts.
class ZeroCopyDrive : public ZeroCopy {
 protected:
  void SetUp() override {
    for (Probe& probe : probes_) {
      probe.first = probe.subscribe(node_, probe.topic);
    }
    for (const char* name : {"Ins", "Filter", "Initializer", "Forecast", "StopSupervisor", "Overlay"}) {
      load(std::string("/") + name, std::string("slipnav/") + name);
    }
    for (Probe& probe : probes_) {
      probe.second = probe.subscribe(node_, probe.topic);
    }
    // What was latched before comes to the second listener as bytes.
    spinUntil([] { return false; }, 0.5);
    for (Probe& probe : probes_) {
      probe.first->received.clear();
      probe.second->received.clear();
    }
  }

  void drive() {
    const SimulatedSensors sensors(config_);
    NeverStop never;
    const ros::SteadyTime begin = ros::SteadyTime::now();
    double simulated_s = 0.0;
    simulateDrive(config_.simulator, Planet::byName(config_.planet), never,
                  [&](const sim::Measurements& measured, const sim::TruthState&) {
                    publish(sensors, measured);
                    simulated_s += 1.0 / config_.simulator.imu.rate_hz;
                    spinUntil([] { return false; }, simulated_s / kRate - (ros::SteadyTime::now() - begin).toSec());
                  });
    for (std::size_t before = 0; before < received();) {
      before = received();
      spinUntil([] { return false; }, 1.0);
    }
    // Of a message that comes just now, both have to have their turn.
    spinUntil(
        [this] { return std::all_of(probes_.begin(), probes_.end(), [](const Probe& p) { return p.isEven(); }); });
  }

  std::size_t received() const {
    return std::accumulate(probes_.begin(), probes_.end(), std::size_t{0},
                           [](std::size_t sum, const Probe& probe) { return sum + probe.second->received.size(); });
  }

  /// Not finite: no start is made from it.
  static geometry_msgs::TwistWithCovarianceStamped velocityAt(const ros::Time& stamp) {
    geometry_msgs::TwistWithCovarianceStamped message;
    message.header.stamp = stamp;
    message.twist.twist.linear.x = std::numeric_limits<double>::quiet_NaN();
    return message;
  }

  void publish(const SimulatedSensors& sensors, const sim::Measurements& measured) {
    if (measured.gps) {
      fixes_.publish(sensors.fix(*measured.gps));
      velocities_.publish(velocityAt(toRosTime(measured.gps->stamp)));
    }
    if (measured.truth) {
      truth_.publish(sensors.fix(*measured.truth));
    }
    if (measured.wheel) {
      commands_.publish(geometry_msgs::Twist());
      wheels_.publish(sensors.joints(*measured.wheel, measured.wheel_angle_rad));
    }
    imu_.publish(sensors.imu(measured.imu));
  }

  Probe& probeOf(const std::string& topic) {
    return *std::find_if(probes_.begin(), probes_.end(), [&topic](const Probe& p) { return p.topic == topic; });
  }

  void expectTheVeryObjects(const Probe& probe) {
    EXPECT_EQ(probe.first->made_of_bytes, 0U);
    EXPECT_FALSE(probe.first->received.empty());
    EXPECT_EQ(probe.first->received, probe.second->received);
  }

  Config config_ = configFromParameters(node_, "slipnav");
  std::vector<Probe> probes_ = probes(config_.topics);
  Source<sensor_msgs::Imu> imu_{node_, config_.topics.imu};
  Source<sensor_msgs::JointState> wheels_{node_, config_.topics.joint_states};
  Source<sensor_msgs::NavSatFix> fixes_{node_, config_.topics.gps_fix};
  Source<geometry_msgs::TwistWithCovarianceStamped> velocities_{node_, config_.topics.gps_velocity};
  Source<sensor_msgs::NavSatFix> truth_{node_, config_.topics.truth_fix};
  Source<geometry_msgs::Twist> commands_{node_, config_.topics.cmd_vel_in};
};

TEST_F(ZeroCopyDrive, EveryTopicPassesTheVeryObjects) {
  drive();
  for (const Probe& probe : probes_) {
    SCOPED_TRACE(probe.topic);
    expectTheVeryObjects(probe);
  }
  EXPECT_EQ(probeOf(config_.topics.imu).first->received, imu_.sent());
  EXPECT_EQ(probeOf(config_.topics.joint_states).first->received, wheels_.sent());
  EXPECT_EQ(probeOf(config_.topics.gps_fix).first->received, fixes_.sent());
  EXPECT_EQ(probeOf(config_.topics.gps_velocity).first->received, velocities_.sent());
  EXPECT_EQ(probeOf(config_.topics.truth_fix).first->received, truth_.sent());
  EXPECT_EQ(probeOf(config_.topics.cmd_vel_in).first->received, commands_.sent());

  // Of latched topics roscpp keeps the bytes of the newest message for those who come later.
  const std::set<std::string> latched = {kInitialStateTopic,        kHandOverTopic,
                                         kInitializationTopic,      config_.topics.path,
                                         config_.topics.truth_path, config_.topics.wheel_path,
                                         config_.topics.markers};
  std::map<std::string, Traffic> counted = traffic();
  const std::set<std::string> to_outside = topicsToOutside();
  for (const Probe& probe : probes_) {
    const std::string name = node_.resolveName(probe.topic);
    EXPECT_EQ(to_outside.count(name), 0U) << name;
    EXPECT_GT(counted[name].messages, 0) << name;
    EXPECT_TRUE(counted[name].bytes == 0 || latched.count(probe.topic) > 0) << name;
  }
}

TEST_F(ZeroCopyDrive, NoTopicIsWithoutAProbe) {
  // TF and diagnostics are for others, and published by libraries of theirs. Tuning is there when somebody tunes;
  // nobody requests a start or an emergency stop in this drive.
  std::set<std::string> known = {"/rosout",
                                 "/tf",
                                 "/tf_static",
                                 node_.resolveName(config_.topics.diagnostics),
                                 node_.resolveName(config_.topics.e_stop),
                                 node_.resolveName(kTuningTopic),
                                 node_.resolveName(kStartRequestTopic)};
  for (const std::string tuned : {"/Filter", "/Forecast", "/StopSupervisor"}) {
    known.insert({tuned + "/parameter_descriptions", tuned + "/parameter_updates"});
  }
  for (const Probe& probe : probes_) {
    known.insert(node_.resolveName(probe.topic));
  }
  std::vector<std::string> advertised;
  ros::this_node::getAdvertisedTopics(advertised);
  for (const std::string& topic : advertised) {
    EXPECT_EQ(known.count(topic), 1U) << topic;
  }
}

}  // namespace
}  // namespace slipnav::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "zero_copy");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
