/// A drive through the nodelets, whose stops the supervisor decides, against the same drive offline: the same stops,
/// the same trajectory and the same estimates, to the last digit. With the parameter `apart`, the simulator is a
/// process of its own.

#include <gtest/gtest.h>
#include <nodelet/NodeletLoad.h>
#include <ros/ros.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "evaluation/simulated_run.h"
#include "ros/runtime/child_process.h"
#include "ros/runtime/parameters.h"

namespace slipnav {
namespace {

/// A folder for results; it is removed in the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    char name[] = "/tmp/slipnav_test_XXXXXX";
    if (mkdtemp(name) == nullptr) {
      throw std::runtime_error("no temporary folder can be made");
    }
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

std::string contents(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// The simulator begins to drive in the manager of the launch file.
void loadSimulator() {
  nodelet::NodeletLoad load;
  load.request.name = "/simulator";
  load.request.type = "slipnav/Simulator";
  ASSERT_TRUE(ros::service::waitForService("/slipnav_manager/load_nodelet", ros::Duration(20.0)));
  ASSERT_TRUE(ros::service::call("/slipnav_manager/load_nodelet", load));
}

/// Has the simulator drive, until it has written its results to `folder`.
void driveThroughNodelets(const std::string& folder) {
  ros::NodeHandle node;
  node.setParam("/simulator/policy", "autonomous");
  node.setParam("/simulator/out", folder);
  std::unique_ptr<ChildProcess> apart;
  if (ros::NodeHandle("~").param("apart", false)) {
    apart = std::make_unique<ChildProcess>(std::vector<std::string>{"rosrun", "nodelet", "nodelet", "standalone",
                                                                    "slipnav/Simulator", "__name:=simulator"});
  } else {
    loadSimulator();
  }
  const ros::SteadyTime begin = ros::SteadyTime::now();
  while (!std::filesystem::exists(folder + "/metrics.json")) {  // the last file
    ASSERT_LT((ros::SteadyTime::now() - begin).toSec(), 120.0) << "the simulation does not end";
    ros::WallDuration(0.1).sleep();
  }
}

TEST(SimulateEquality, TheDriveIsThatOfTheOfflineSimulation) {
  const Config config = configFromParameters(ros::NodeHandle(), "slipnav");
  const TemporaryFolder folder;
  const RunReport offline = simulateAndMeasure(config, *makeStopPolicy("autonomous", config.stop)).run;
  EXPECT_GE(offline.metrics.stop_count, 2);
  writeRunReport(folder / "offline", offline);
  driveThroughNodelets(folder / "nodelets");
  for (const std::string file : {"truth.tum", "timeline.csv", "estimate.tum", "forecasts.csv"}) {
    EXPECT_TRUE(contents(folder / "nodelets/" + file) == contents(folder / "offline/" + file)) << file;
  }
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "simulate_equality");
  return RUN_ALL_TESTS();
}
