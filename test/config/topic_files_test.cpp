/// Files that name topics know those that there are.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "config/config.h"
#include "config/sensor_topics.h"
#include "config/yaml_writer.h"

namespace slipnav {
namespace {

std::string contentOf(const std::string& name) {
  std::ifstream file(std::string(SLIPNAV_SOURCE_DIR) + "/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Default names of all topics, and those that ROS itself fixes.
std::set<std::string> knownTopics() {
  std::set<std::string> topics = {"/tf", "/tf_static", "/diagnostics", "initialization"};
  const YAML::Node names = YAML::Load(toYaml(TopicNames()));
  for (const auto& name : names) {
    topics.insert(name.second.as<std::string>());
  }
  return topics;
}

/// Lines that are no comments.
std::set<std::string> listedIn(const std::string& name) {
  std::istringstream lines(contentOf(name));
  std::set<std::string> listed;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line[0] != '#') {
      EXPECT_EQ(knownTopics().count(line), 1U) << line;
      listed.insert(line);
    }
  }
  return listed;
}

TEST(TopicFiles, TheListForRecordingNamesTopicsThatThereAre) {
  const std::set<std::string> listed = listedIn("config/record_topics.txt");
  for (const char* needed : {"imu/data", "joint_states", "wheel_odometry", "gps/fix", "truth/fix", "odometry"}) {
    EXPECT_EQ(listed.count(needed), 1U) << needed;
  }
}

TEST(TopicFiles, TheListForPlayingNamesTheSensorsAndNothingElse) {
  std::set<std::string> sensors = {"/tf_static"};
  for (const std::string& topic : sensorTopics(TopicNames())) {
    sensors.insert(topic);
  }
  EXPECT_EQ(listedIn("config/sensor_topics.txt"), sensors);
}

TEST(TopicFiles, ThePlotLayoutNamesTopicsThatThereAre) {
  const std::string layout = contentOf("config/plotjuggler.xml");
  const std::string key = " name=\"/";
  int curves = 0;
  for (std::size_t at = layout.find(key); at != std::string::npos; at = layout.find(key, at + 1)) {
    const std::size_t begin = at + key.size();
    const std::string topic = layout.substr(begin, layout.find('/', begin) - begin);
    EXPECT_EQ(knownTopics().count(topic), 1U) << topic;
    ++curves;
  }
  EXPECT_GT(curves, 20);
}

}  // namespace
}  // namespace slipnav
