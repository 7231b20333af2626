#pragma once
/// Wheels of the vehicle, and its planar motion from their rates.

#include <string>
#include <vector>

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// One driven wheel as configured. Position in the vehicle's REP-103 axes: x forward, y left.
struct WheelParams {
  std::string name;
  double radius_m = 0.11;
  double x_m = 0.0;
  double y_m = 0.0;
  double sign = 1.0;  ///< −1 where the encoder counts backwards when the rover drives forward
  void visit(ParameterVisitor& v);
};

/// The paper's rover: front left, front right, back left, back right.
std::vector<WheelParams> pathfinderWheels();

/// Least-squares forward speed and heading rate of the wheels' circumferential speeds.
struct PlanarMotion {
  double forward_mps = 0.0;
  double yaw_rate_radps = 0.0;  ///< about body z, down: positive turns right
  bool has_yaw_rate = false;
};

/// Wheel positions, and the vehicle motion that follows from their rates. Immutable.
class WheelGeometry {
 public:
  /// @param scrub_factor how much wider the track appears when a skid-steered rover turns; 1 for no scrubbing
  /// Throws std::invalid_argument that names the error in the list.
  WheelGeometry(std::vector<WheelParams> wheels, double scrub_factor);

  std::size_t count() const { return wheels_.size(); }
  const WheelParams& wheel(std::size_t i) const { return wheels_[i]; }

  /// r·ω of wheel i [m/s].
  double circumferentialSpeed(const WheelSample& sample, std::size_t i) const {
    return wheels_[i].radius_m * sample.rate_radps[i];
  }

  /// Least-squares fit of v_i = u − r y_i (y to the right) over all wheels; no heading rate from a single track line.
  PlanarMotion motion(const WheelSample& sample) const;

 private:
  std::vector<WheelParams> wheels_;
  double scrub_factor_;
  double mean_y_right_m_;
  double sum_square_y_m2_;
};

}  // namespace slipnav
