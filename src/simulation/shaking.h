#pragma once
/// Vibration that an IMU senses and that does not move the rover: broadband from the ground, motor and engine lines.

#include <array>
#include <cstdint>

#include "simulation/inertial_truth.h"
#include "simulation/params.h"
#include "simulation/random.h"

namespace slipnav::sim {

/// Vibration added to the smooth motion in each sample. Lines alias according to the sampling: an instantaneous sample
/// has their value at its instant, a mean the mean over the interval.
class Shaking {
 public:
  Shaking(const ShakingParams& params, bool samples_mean, std::uint64_t seed);

  /// One fine step.
  /// @param travel_m of the wheels' surface at its end
  void advance(double travel_m, double dt_s);
  /// Vibration in the sample that ends here.
  InertialMean sample(double speed_mps);

 private:
  static constexpr std::size_t kHarmonics = 3;
  using Phases = std::array<double, 6 * kHarmonics>;

  InertialMean lines(double turns, const Phases& phases, double accel_mps2, double gyro_radps) const;

  ShakingParams params_;
  bool active_;
  bool samples_mean_;
  RandomStream stream_;
  Phases motor_phases_;
  Phases engine_phases_;
  double time_s_ = 0.0;
  double last_travel_m_ = 0.0;
  InertialMean sum_;
  int steps_ = 0;
};

}  // namespace slipnav::sim
