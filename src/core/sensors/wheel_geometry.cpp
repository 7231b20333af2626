#include "slipnav/core/sensors/wheel_geometry.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace slipnav {

void WheelParams::visit(ParameterVisitor& v) {
  v.text("name", name, "joint name of the wheel");
  v.number("radius_m", radius_m, {1e-3, 10.0}, "rolling radius [m]");
  v.number("x_m", x_m, {-100.0, 100.0}, "position ahead of base_link [m]");
  v.number("y_m", y_m, {-100.0, 100.0}, "position left of base_link [m]");
  v.number("sign", sign, {-1.0, 1.0}, "-1 where the encoder counts backwards in forward driving, else 1");
}

std::vector<WheelParams> pathfinderWheels() {
  constexpr double kRadius_m = 0.11;
  constexpr double kHalfBase_m = 0.555 / 2.0;
  constexpr double kHalfTrack_m = 0.685 / 2.0;
  return {{"front_left_wheel", kRadius_m, kHalfBase_m, kHalfTrack_m, 1.0},
          {"front_right_wheel", kRadius_m, kHalfBase_m, -kHalfTrack_m, 1.0},
          {"back_left_wheel", kRadius_m, -kHalfBase_m, kHalfTrack_m, 1.0},
          {"back_right_wheel", kRadius_m, -kHalfBase_m, -kHalfTrack_m, 1.0}};
}

WheelGeometry::WheelGeometry(std::vector<WheelParams> wheels, double scrub_factor)
    : wheels_(std::move(wheels)), scrub_factor_(scrub_factor), mean_y_right_m_(0.0), sum_square_y_m2_(0.0) {
  if (wheels_.empty() || wheels_.size() > kMaxWheels) {
    throw std::invalid_argument("wheels: " + std::to_string(wheels_.size()) + " given, 1 to " +
                                std::to_string(kMaxWheels) + " can be used");
  }
  if (!(scrub_factor > 0.0)) {
    throw std::invalid_argument("wheel.scrub_factor must be above zero");
  }
  for (const WheelParams& wheel : wheels_) {
    if (std::abs(wheel.sign) != 1.0) {
      throw std::invalid_argument("wheels: sign of '" + wheel.name + "' must be 1 or -1");
    }
    mean_y_right_m_ -= wheel.y_m / static_cast<double>(wheels_.size());
  }
  for (const WheelParams& wheel : wheels_) {
    const double offset_m = -wheel.y_m - mean_y_right_m_;
    sum_square_y_m2_ += offset_m * offset_m;
  }
}

PlanarMotion WheelGeometry::motion(const WheelSample& sample) const {
  double mean = 0.0;
  double moment = 0.0;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const double speed = circumferentialSpeed(sample, i);
    mean += speed / static_cast<double>(wheels_.size());
    moment += speed * (-wheels_[i].y_m - mean_y_right_m_);
  }
  PlanarMotion motion;
  motion.has_yaw_rate = sum_square_y_m2_ > 1e-6;
  if (motion.has_yaw_rate) {
    motion.yaw_rate_radps = -moment / (sum_square_y_m2_ * scrub_factor_);
  }
  motion.forward_mps = mean + motion.yaw_rate_radps * mean_y_right_m_;
  return motion;
}

}  // namespace slipnav
