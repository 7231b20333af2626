#include "slipnav/core/ekf/stationary_detector.h"

#include <algorithm>
#include <cmath>

#include "core/base/square.h"

namespace slipnav {
namespace {

constexpr std::size_t kRingSize = 2048;  // two seconds at the highest IMU rate

constexpr double kRestMemory_s = 10.0;
constexpr double kDriveMemory_s = 5.0;
constexpr double kLevelKnown_s = 1.0;
/// How far scatter at rest may be above its previous level, in standard deviations of the sensor.
constexpr double kRestFactor = 3.0;
/// Rest is at least this much calmer than driving.
constexpr double kCalmerThanDriving = 3.0;
constexpr double kStillCalmer = 1.5;
/// Before the wheels have ever turned, and before any rest is known: an engine may be running.
constexpr double kBeforeDriving = 6.0;
constexpr double kNoiseFactor = 2.0;
constexpr double kBiasSigmas = 4.0;
constexpr double kForceTolerance_mps2 = 0.05;
constexpr double kRateTolerance_radps = 0.1 * kPi / 180.0;
/// Largest speed that encoder noise may show at rest.
constexpr double kLargestRestSpeed_mps = 0.005;

}  // namespace

void StationaryParams::visit(ParameterVisitor& v) {
  v.number("window_s", window_s, {0.02, 2.0}, "length of the IMU's test window [s]");
  v.number("hold_off_s", hold_off_s, {0.0, 10.0}, "how long the wheels must have been at rest [s]");
  v.number("wheel_speed_mps", wheel_speed_mps, {0.0, 1.0},
           "highest circumferential speed of a wheel at rest, unless larger noise is learned [m/s]");
  v.number("accel_std_mps2", accel_std_mps2, {1e-6, 10.0},
           "largest scatter of the specific force at rest, 1σ of each axis, before it is learned [m/s²]");
  v.number("gyro_std_deg_per_s", gyro_std_deg_per_s, {1e-6, 100.0}, "likewise of the angular rate [°/s]");
}

StationaryDetector::StationaryDetector(const StationaryParams& params, const ImuFloor& floor)
    : params_(params), floor_(floor), ring_(kRingSize) {}

void StationaryDetector::reset() {
  head_ = 0;
  size_ = 0;
  wheels_at_rest_ = false;
  has_driven_ = false;
  last_judged_ = 0;
  rest_ = Level{};
  drive_ = Level{};
}

void StationaryDetector::addImu(Nanoseconds stamp, const Vector3& f_ib_b, const Vector3& omega_ib_b) {
  ring_[head_] = {stamp, f_ib_b, omega_ib_b};
  head_ = (head_ + 1) % kRingSize;
  size_ = size_ < kRingSize ? size_ + 1 : kRingSize;
}

void StationaryDetector::addWheels(Nanoseconds stamp, double largest_speed_mps, double noise_std_mps) {
  const double limit_mps = std::max(params_.wheel_speed_mps, std::min(noise_std_mps, kLargestRestSpeed_mps));
  const bool at_rest = largest_speed_mps <= limit_mps;
  if (at_rest && !wheels_at_rest_) {
    wheels_at_rest_since_ = stamp;
  }
  wheels_at_rest_ = at_rest;
  has_driven_ = has_driven_ || !at_rest;
  last_wheels_ = stamp;
}

void StationaryDetector::Level::add(const Window& window, double interval_s, double memory_s) {
  time_s = std::min(time_s + interval_s, memory_s);
  const double gain = time_s > 0.0 ? std::min(interval_s / time_s, 1.0) : 1.0;
  accel_variance += gain * (window.accel_variance - accel_variance);
  gyro_variance += gain * (window.gyro_variance - gyro_variance);
}

StationaryDetector::Window StationaryDetector::window() const {
  Window w;
  if (size_ == 0) {
    return w;
  }
  const Sample& origin = ring_[(head_ + kRingSize - 1) % kRingSize];  // differences to it preserve precision
  const Nanoseconds begin = origin.stamp - fromSeconds(params_.window_s);
  Vector3 sum_f = Vector3::Zero();
  Vector3 sum_rate = Vector3::Zero();
  double sum_f2 = 0.0;
  double sum_rate2 = 0.0;
  std::size_t n = 0;
  for (; n < size_; ++n) {
    const Sample& sample = ring_[(head_ + kRingSize - 1 - n) % kRingSize];
    if (sample.stamp <= begin) {
      w.filled = true;
      break;
    }
    const Vector3 f = sample.f_ib_b - origin.f_ib_b;
    const Vector3 rate = sample.omega_ib_b - origin.omega_ib_b;
    sum_f += f;
    sum_f2 += f.squaredNorm();
    sum_rate += rate;
    sum_rate2 += rate.squaredNorm();
  }
  const double count = static_cast<double>(n);
  w.f_ib_b = origin.f_ib_b + sum_f / count;
  w.omega_ib_b = origin.omega_ib_b + sum_rate / count;
  w.accel_variance = std::max(0.0, sum_f2 - sum_f.squaredNorm() / count) / (3.0 * count);
  w.gyro_variance = std::max(0.0, sum_rate2 - sum_rate.squaredNorm() / count) / (3.0 * count);
  w.period_s = params_.window_s / count;
  w.filled = w.filled || size_ == kRingSize;
  return w;
}

bool StationaryDetector::scattersLikeRest(const Window& w) const {
  const bool rest_known = rest_.time_s >= kLevelKnown_s;
  const double freedom = has_driven_ || rest_known ? 1.0 : kBeforeDriving;
  double accel = square(freedom * params_.accel_std_mps2);
  double gyro = square(freedom * degToRad(params_.gyro_std_deg_per_s));
  accel = std::max(accel, square(kNoiseFactor) * floor_.accel_density / w.period_s);
  gyro = std::max(gyro, square(kNoiseFactor) * floor_.gyro_density / w.period_s);
  const bool drive_known = drive_.time_s >= kLevelKnown_s;
  const double calm_accel = drive_.accel_variance / square(kCalmerThanDriving);
  const double calm_gyro = drive_.gyro_variance / square(kCalmerThanDriving);
  if (rest_known) {
    accel = std::max(square(kRestFactor) * rest_.accel_variance, drive_known ? std::min(accel, calm_accel) : accel);
    gyro = std::max(square(kRestFactor) * rest_.gyro_variance, drive_known ? std::min(gyro, calm_gyro) : gyro);
  } else if (drive_known) {
    accel = std::max(accel, calm_accel);
    gyro = std::max(gyro, calm_gyro);
  }
  return w.accel_variance <= accel && w.gyro_variance <= gyro;
}

bool StationaryDetector::meansAreThoseOfRest(const Window& w, double gravity_mps2) const {
  return std::abs(w.f_ib_b.norm() - gravity_mps2) <= kBiasSigmas * floor_.accel_bias_std + kForceTolerance_mps2 &&
         w.omega_ib_b.norm() <= kBiasSigmas * floor_.gyro_bias_std + kRateTolerance_radps;
}

bool StationaryDetector::hasLevelOfRest(double gravity_mps2) const {
  const Window w = window();
  return w.filled && meansAreThoseOfRest(w, gravity_mps2);
}

bool StationaryDetector::isCalmerThanDriving(bool was) const {
  const Window w = window();
  const double factor = square(was ? kStillCalmer : kCalmerThanDriving);
  return w.filled && drive_.time_s >= kLevelKnown_s && factor * w.accel_variance <= drive_.accel_variance &&
         factor * w.gyro_variance <= drive_.gyro_variance;
}

bool StationaryDetector::judge(double gravity_mps2, bool drives) {
  const Window w = window();
  const double interval_s = last_judged_ == 0 ? 0.0 : std::min(toSeconds(last_wheels_ - last_judged_), 1.0);
  last_judged_ = last_wheels_;
  if (!w.filled) {
    return false;
  }
  if (!wheels_at_rest_) {
    if (drives) {
      drive_.add(w, interval_s, kDriveMemory_s);
    }
    return false;
  }
  const bool at_rest = last_wheels_ - wheels_at_rest_since_ >= fromSeconds(params_.hold_off_s) && scattersLikeRest(w) &&
                       meansAreThoseOfRest(w, gravity_mps2);
  if (at_rest) {
    rest_.add(w, interval_s, kRestMemory_s);
  }
  return at_rest;
}

}  // namespace slipnav
