#include "slipnav/core/navigation/input_check.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

namespace slipnav {
namespace {

constexpr Nanoseconds kWindow = 2 * kSecond;
constexpr double kLeastSamples = 10.0;
/// Over a window a rover gains a few m/s at most; sensors are off by a few percent.
constexpr double kForceTolerance = 0.25;
constexpr double kStandardGravity_mps2 = 9.80665;
/// Below this share of gravity, the rest is bias and tilt.
constexpr double kNoGravity = 0.25;
/// No rover stands on a slope of 60°.
constexpr double kLeastUpward = 0.5;
/// °/s for rad/s is a factor of 57; slip, scrub and noise amount to a few.
constexpr double kUnitFactor = 15.0;
constexpr double kOppositeTurn = -0.3;
/// Of two turns, not of noise: straight ahead on rough ground the wheels turn by 0.5 rad in a few seconds, back and
/// forth.
constexpr double kSureTurn = 0.7;
constexpr double kLeastTurn_rad = 0.5;
constexpr double kLeastTilt_rad = 0.1;
constexpr double kLeastWindows = 5.0;

std::string number(double value) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed << std::setprecision(2) << value;
  return out.str();
}

bool isAbout(double length, double value) { return std::abs(length / value - 1.0) < kForceTolerance; }

}  // namespace

std::string complaintOfForce(double length_mps2, double gravity_mps2) {
  if (isAbout(length_mps2, gravity_mps2)) {
    return "";
  }
  const std::string measured =
      "the mean specific force is " + number(length_mps2) + " where gravity is " + number(gravity_mps2) + " m/s^2: ";
  if (isAbout(length_mps2, gravity_mps2 / kStandardGravity_mps2)) {
    return measured + "in g? the driver must publish m/s^2";
  }
  if (length_mps2 < kNoGravity * gravity_mps2) {
    return measured + "gravity taken out? use the driver's topic that includes it, or switch that off";
  }
  return measured + "another unit, or another planet? the driver must publish m/s^2, see planet";
}

std::string complaintOfRateUnit(const std::string& than_what) {
  return "the gyros turn " + than_what + ": in deg/s? the driver must publish rad/s";
}

std::string complaintOfDirection(bool has_sign) {
  return std::string("wheels and IMU disagree on the direction: ") + (has_sign ? "" : "the wheel speed has no sign, ") +
         "wheels[].sign is wrong, or imu.mount is turned by 180 deg about z";
}

void InputCheck::Spread::add(const Vector2& value) {
  count += 1.0;
  sum += value;
  sum_square += value.squaredNorm();
}

double InputCheck::Spread::variance() const {
  return count > 0.0 ? std::max((sum_square - sum.squaredNorm() / count) / count, 0.0) : 0.0;
}

InputCheck::InputCheck(double gravity_mps2, double rest_speed_mps)
    : gravity_mps2_(gravity_mps2), rest_speed_mps_(rest_speed_mps), direction_(rest_speed_mps) {}

void InputCheck::push(const ImuSample& sample) {
  if (!sample.f_ib_b.allFinite() || !sample.omega_ib_b.allFinite() || sample.stamp <= newest_imu_) {
    return;
  }
  direction_.push(sample);
  const double dt_s = newest_imu_ == 0 ? 0.0 : std::min(toSeconds(sample.stamp - newest_imu_), toSeconds(kWindow));
  newest_imu_ = sample.stamp;
  gyro_turn_rad_ += dt_s * sample.omega_ib_b.z();
  if (window_.count == 0.0) {
    window_.begin = sample.stamp;
  }
  window_.force += sample.f_ib_b;
  window_.turned += dt_s * sample.omega_ib_b;
  window_.count += 1.0;
  if (sample.stamp - window_.begin >= kWindow) {
    closeWindow();
  }
  chooseComplaint();
}

void InputCheck::closeWindow() {
  if (window_.count >= kLeastSamples) {
    const Vector3 mean_force = window_.force / window_.count;
    judgeForce(mean_force);
    judgeTilt(mean_force, window_.turned);
    last_force_ = mean_force;
    last_turned_ = window_.turned;
  }
  window_ = Window{};
}

void InputCheck::judgeForce(const Vector3& mean_force) {
  const double length = mean_force.norm();
  const bool right = isAbout(length, gravity_mps2_);
  if (!right && complained_force_mps2_ != 0.0) {
    return;  // already reported; on slopes the residual of gravity changes
  }
  complained_force_mps2_ = right ? 0.0 : length;
  force_complaint_ = complaintOfForce(length, gravity_mps2_);
  if (right && -mean_force.z() < kLeastUpward * length) {
    force_complaint_ =
        "the specific force does not point up: imu.mount does not match the sensor, or the "
        "driver publishes gravity with the wrong sign; a level sensor at rest reads +9.8 m/s^2 on the axis that "
        "points up";
  }
}

/// Between the midpoints of two windows the gyros have turned by half of what they turned in each.
void InputCheck::judgeTilt(const Vector3& mean_force, const Vector3& turned) {
  if (last_force_.isZero() || !force_complaint_.empty()) {
    return;
  }
  const Vector3 change = last_force_.normalized().cross(mean_force.normalized());  // seen from the body: backwards
  tilt_by_force_.add(-change.head<2>());
  tilt_by_gyro_.add(0.5 * (last_turned_ + turned).head<2>());
  const double by_gyro = std::sqrt(tilt_by_gyro_.variance());
  if (tilt_by_gyro_.count >= kLeastWindows && by_gyro > kLeastTilt_rad &&
      by_gyro > kUnitFactor * std::sqrt(tilt_by_force_.variance())) {
    rate_complaint_ = complaintOfRateUnit("far more than the specific force tilts");
  }
}

void InputCheck::push(const WheelMotion& wheels) {
  direction_.push(wheels);
  const double dt_s = newest_wheels_ == 0 ? 0.0 : toSeconds(wheels.stamp - newest_wheels_);
  newest_wheels_ = wheels.stamp;
  const double gyro_turn_rad = gyro_turn_rad_;
  gyro_turn_rad_ = 0.0;
  if (dt_s <= 0.0 || dt_s > 1.0 || !wheels.motion.has_yaw_rate) {
    return;
  }
  const double turn_rad = dt_s * wheels.motion.yaw_rate_radps;
  wheels_turned_rad_ += std::abs(turn_rad);
  wheels_squared_ += turn_rad * turn_rad;
  gyro_squared_ += gyro_turn_rad * gyro_turn_rad;
  gyro_by_wheels_ += turn_rad * gyro_turn_rad;
  judgeTurns();
  chooseComplaint();
}

void InputCheck::judgeTurns() {
  if (wheels_turned_rad_ < kLeastTurn_rad) {
    return;
  }
  const double ratio = gyro_by_wheels_ / wheels_squared_;
  const double correlation = gyro_by_wheels_ / std::sqrt(std::max(gyro_squared_ * wheels_squared_, 1e-30));
  if (ratio > kUnitFactor) {
    rate_complaint_ = complaintOfRateUnit("more than 15 times as far as the wheels");
  } else if (ratio < kOppositeTurn && correlation < -kSureTurn) {
    turn_complaint_ =
        "gyros and wheels turn in opposite directions: imu.mount is upside down, the gyro's axes are not "
        "those of the accelerometer, or left and right wheels are swapped";
  } else if (ratio > -kOppositeTurn && correlation > kSureTurn) {
    turn_complaint_.clear();
  }
  wheels_turned_rad_ = wheels_squared_ = gyro_squared_ = gyro_by_wheels_ = 0.0;
}

void InputCheck::chooseComplaint() {
  if (!force_complaint_.empty()) {
    complaint_ = force_complaint_;
  } else if (!rate_complaint_.empty()) {
    complaint_ = rate_complaint_;
  } else if (!turn_complaint_.empty()) {
    complaint_ = turn_complaint_;
  } else if (direction_.contradicts()) {
    complaint_ = complaintOfDirection(direction_.hasSign());
  } else {
    complaint_.clear();
  }
}

}  // namespace slipnav
