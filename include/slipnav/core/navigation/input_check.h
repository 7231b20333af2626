#pragma once
/// Inputs that contradict physics: units, signs and axes other than configured.
///
/// The checks need no filter and no start:
///   - the mean specific force over two seconds is gravity's reaction: its magnitude gives the unit and whether
///     gravity has been removed, its direction reveals a mounting that is upside down;
///   - the angular rate against the heading rate of the wheels, and against the tilt from the specific force,
///     reveals a unit of °/s and axes with the wrong sign;
///   - the direction of each start from rest (DirectionCheck).

#include <string>

#include "slipnav/core/navigation/direction_check.h"

namespace slipnav {

/// What the magnitude of a mean specific force says about its unit, with cause and remedy; "" if it is about gravity's.
/// @param length_mps2 mean over a second or more; @param gravity_mps2 approximate local value
std::string complaintOfForce(double length_mps2, double gravity_mps2);

/// Complaint about gyros that turn far more than anything else indicates.
std::string complaintOfRateUnit(const std::string& than_what);

/// Wheels and IMU contradict each other on the direction. @param has_sign whether the wheel speed is ever negative
std::string complaintOfDirection(bool has_sign);

/// Takes samples in order of stamp, as long as the rover drives.
class InputCheck {
 public:
  /// @param gravity_mps2 approximate local value; @param rest_speed_mps wheels slower than this are at rest
  InputCheck(double gravity_mps2, double rest_speed_mps);

  /// Forgets everything.
  void reset() { *this = InputCheck(gravity_mps2_, rest_speed_mps_); }

  void push(const ImuSample& sample);
  void push(const WheelMotion& wheels);

  /// What is wrong, in one line with cause and remedy; otherwise "". An estimate from such samples is worthless.
  const std::string& complaint() const { return complaint_; }

 private:
  /// Sums over one window, and the result of the previous one.
  struct Window {
    Nanoseconds begin = 0;
    Vector3 force = Vector3::Zero();
    Vector3 turned = Vector3::Zero();  ///< ∫ω dt [rad]
    double count = 0.0;
  };
  /// Mean and spread of a number of vectors.
  struct Spread {
    double count = 0.0;
    Vector2 sum = Vector2::Zero();
    double sum_square = 0.0;
    void add(const Vector2& value);
    double variance() const;
  };

  void closeWindow();
  void judgeForce(const Vector3& mean_force);
  void judgeTilt(const Vector3& mean_force, const Vector3& turned);
  void judgeTurns();
  void chooseComplaint();

  double gravity_mps2_;
  double rest_speed_mps_;
  DirectionCheck direction_;
  Window window_;
  Nanoseconds newest_imu_ = 0;
  Vector3 last_force_ = Vector3::Zero();   ///< mean of the previous window; zero: there is none
  Vector3 last_turned_ = Vector3::Zero();  ///< in the previous window [rad]
  Spread tilt_by_force_;                   ///< change of roll and pitch between windows [rad]
  Spread tilt_by_gyro_;                    ///< likewise
  double gyro_turn_rad_ = 0.0;             ///< about body z, since the previous wheel sample
  Nanoseconds newest_wheels_ = 0;
  double wheels_squared_ = 0.0;  ///< Σ of the wheels' turns squared
  double gyro_by_wheels_ = 0.0;  ///< Σ of their products with the gyro's
  double gyro_squared_ = 0.0;
  double wheels_turned_rad_ = 0.0;
  std::string force_complaint_;
  double complained_force_mps2_ = 0.0;  ///< of the first wrong window; alarms are identified by their text
  std::string rate_complaint_;
  std::string turn_complaint_;  ///< until gyros and wheels clearly turn together
  std::string complaint_;
};

}  // namespace slipnav
