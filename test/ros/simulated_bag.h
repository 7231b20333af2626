#pragma once
/// A short simulated drive as a recording for tests.

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <stdlib.h>

#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>

#include "config/config.h"
#include "evaluation/simulated_drive.h"
#include "ros/bag/bag_writer.h"

namespace slipnav::test {

/// A path in the temporary folder; the file is removed in the end.
class TemporaryBag {
 public:
  TemporaryBag() {
    char name[] = "/tmp/slipnav_test_XXXXXX.bag";
    const int file = mkstemps(name, 4);
    if (file < 0) {
      throw std::runtime_error("no temporary file can be made");
    }
    close(file);
    path_ = name;
  }
  ~TemporaryBag() { std::remove(path_.c_str()); }
  TemporaryBag(const TemporaryBag&) = delete;
  TemporaryBag& operator=(const TemporaryBag&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Rest, straight initialization drive, a few meters of route with a stop in them: about 45 s.
inline void writeShortDrive(const std::string& path, const Config& config, int seed = 1) {
  sim::SimulatorParams params = config.simulator;
  params.seed = seed;
  params.drive.initial_rest_s = 8.0;
  params.drive.distance_m = 10.0;
  params.drive.final_rest_s = 2.0;
  BagWriter writer(path, config);
  PeriodicStops stops(5.0, 2.0);
  simulateDrive(params, Planet::byName(config.planet), stops,
                [&writer](const sim::Measurements& measurements, const sim::TruthState& truth) {
                  writer.write(measurements, truth);
                });
  writer.close();
}

/// Copies a recording message by message; `edit` writes what it wants to have of each.
inline void editBag(const std::string& from, const std::string& to,
                    const std::function<void(const rosbag::MessageInstance&, rosbag::Bag&)>& edit) {
  rosbag::Bag source(from);
  rosbag::Bag target(to, rosbag::bagmode::Write);
  for (const rosbag::MessageInstance& instance : rosbag::View(source)) {
    edit(instance, target);
  }
}

}  // namespace slipnav::test
