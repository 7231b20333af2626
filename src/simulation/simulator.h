#pragma once
/// Closed-loop simulation of a skid-steered rover with its IMU, wheel encoders and differential GNSS.
///
///   RoverSimulator rover(params, Planet::byName("earth"));
///   Driver driver(params);
///   while (!driver.finished()) {
///     const Measurements m = rover.step(driver.command(rover.truth()));
///     ...
///   }
///
/// See doc/simulator.md for what is modeled.

#include <memory>
#include <optional>
#include <vector>

#include "simulation/params.h"
#include "simulation/truth_state.h"
#include "slipnav/core/base/sensors.h"
#include "slipnav/core/earth/planet.h"

namespace slipnav::sim {

/// The operator's command to the rover.
struct Command {
  double forward_mps = 0.0;
  double yaw_rate_radps = 0.0;  ///< about body down: positive turns right
};

/// One sample of the encoders.
struct WheelReading {
  WheelSample sample;
  EncoderAngles angle_rad = {};  ///< accumulated, quantized
};

/// Sensor outputs in one IMU interval. The optional ones were sampled inside that interval.
struct Measurements {
  ImuSample imu;
  std::optional<WheelSample> wheel;
  EncoderAngles wheel_angle_rad = {};        ///< accumulated, quantized; goes with `wheel`
  std::vector<WheelReading> earlier_wheels;  ///< before `wheel`, when encoders are faster than the IMU
  std::optional<GnssFix> gps;                ///< for initialization
  std::optional<GnssFix> truth;              ///< for metrics only
};

/// The rover, the ground under it, and its sensors.
class RoverSimulator {
 public:
  /// Throws std::invalid_argument that names a parameter out of range.
  RoverSimulator(const SimulatorParams& params, const Planet& planet);
  ~RoverSimulator();
  RoverSimulator(RoverSimulator&&) noexcept;
  RoverSimulator& operator=(RoverSimulator&&) noexcept;

  /// Advances by one IMU interval under a constant command.
  Measurements step(const Command& command);

  /// The state at the stamp of the last IMU sample (at first: the start pose).
  const TruthState& truth() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace slipnav::sim
