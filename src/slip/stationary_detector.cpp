#include "slipnav/slip/stationary_detector.h"

#include <limits>

namespace slipnav {
namespace {

constexpr std::size_t kRingSize = 2048;  // two seconds at the highest IMU rate

}  // namespace

void StationaryParams::visit(ParameterVisitor& v) {
  v.number("window_s", window_s, {0.02, 2.0}, "length of the IMU's test window [s]");
  v.number("hold_off_s", hold_off_s, {0.0, 10.0}, "how long the wheels must have rested before it counts [s]");
  v.number("wheel_speed_mps", wheel_speed_mps, {0.0, 1.0}, "highest circumferential speed of a wheel at rest [m/s]");
  v.number("accel_std_mps2", accel_std_mps2, {1e-6, 10.0}, "1σ of the specific force of a rover at rest [m/s²]");
  v.number("gyro_std_deg_per_s", gyro_std_deg_per_s, {1e-6, 100.0}, "1σ of the angular rate of a rover at rest [°/s]");
  v.number("shoe_threshold", shoe_threshold, {0.0, 1e6},
           "limit of the test statistic; 6 is the mean for noise of the two deviations above");
}

StationaryDetector::StationaryDetector(const StationaryParams& params) : params_(params), ring_(kRingSize) {}

void StationaryDetector::reset() {
  head_ = 0;
  size_ = 0;
  wheels_at_rest_ = false;
}

void StationaryDetector::addImu(Nanoseconds stamp, const Vector3& f_ib_b, const Vector3& omega_ib_b) {
  ring_[head_] = {stamp, f_ib_b, omega_ib_b.squaredNorm()};
  head_ = (head_ + 1) % kRingSize;
  size_ = size_ < kRingSize ? size_ + 1 : kRingSize;
}

void StationaryDetector::addWheels(Nanoseconds stamp, double largest_speed_mps) {
  const bool at_rest = largest_speed_mps <= params_.wheel_speed_mps;
  if (at_rest && !wheels_at_rest_) {
    wheels_at_rest_since_ = stamp;
  }
  wheels_at_rest_ = at_rest;
  last_wheels_ = stamp;
}

bool StationaryDetector::isStationary(double gravity_mps2) const {
  return wheels_at_rest_ && last_wheels_ - wheels_at_rest_since_ >= fromSeconds(params_.hold_off_s) &&
         shoeStatistic(gravity_mps2) < params_.shoe_threshold;
}

double StationaryDetector::shoeStatistic(double gravity_mps2) const {
  if (size_ == 0) {
    return std::numeric_limits<double>::infinity();
  }
  const Nanoseconds newest = ring_[(head_ + kRingSize - 1) % kRingSize].stamp;
  const Nanoseconds begin = newest - fromSeconds(params_.window_s);
  Vector3 sum_f = Vector3::Zero();
  double sum_f2 = 0.0;
  double sum_rate2 = 0.0;
  std::size_t n = 0;
  bool filled = false;
  for (; n < size_; ++n) {
    const Sample& sample = ring_[(head_ + kRingSize - 1 - n) % kRingSize];
    if (sample.stamp <= begin) {
      filled = true;
      break;
    }
    sum_f += sample.f_ib_b;
    sum_f2 += sample.f_ib_b.squaredNorm();
    sum_rate2 += sample.rate2;
  }
  if (!filled && size_ < kRingSize) {
    return std::numeric_limits<double>::infinity();
  }
  // Σ |f − g f̄/|f̄||², multiplied out with Σ f = n f̄
  const double count = static_cast<double>(n);
  const double force = sum_f2 - 2.0 * gravity_mps2 * sum_f.norm() + count * gravity_mps2 * gravity_mps2;
  const double gyro_std = degToRad(params_.gyro_std_deg_per_s);
  return (force / (params_.accel_std_mps2 * params_.accel_std_mps2) + sum_rate2 / (gyro_std * gyro_std)) / count;
}

}  // namespace slipnav
