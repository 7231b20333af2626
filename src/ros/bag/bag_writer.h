#pragma once
/// A simulated drive as a recording, with the topics, frames and axes of a real robot.

#include <memory>
#include <string>

#include "config/config.h"
#include "simulation/simulator.h"

namespace slipnav {

/// Writes imu/data in the sensor's own axes, joint_states with positions and velocities, gps/fix, truth/fix, and the
/// exact truth/odometry (map frame about the start) at the rate of the wheels.
class BagWriter {
 public:
  /// Throws std::invalid_argument if the configuration has a different number of wheels than the simulated rover, and
  /// std::runtime_error that names the file if it cannot be written.
  BagWriter(const std::string& path, const Config& config);
  ~BagWriter();
  BagWriter(BagWriter&&) noexcept;
  BagWriter& operator=(BagWriter&&) noexcept;

  /// Samples in the order of their stamps; call for one interval after another.
  void write(const sim::Measurements& measurements, const sim::TruthState& truth);

  /// Completes the file. Without it the file is removed.
  void close();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipnav
