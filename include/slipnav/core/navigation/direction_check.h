#pragma once
/// Do wheels and IMU agree on the direction in which the rover starts to drive?
///
/// At each start from rest the velocity is integrated from the specific force for a moment, with the IMU means
/// at rest (gravity, biases) removed and rotated back by the gyros. Compared with the wheel speed it tells forward from
/// backward, whatever the slip: spinning wheels give a ratio between 0 and 1, never below 0.

#include <deque>

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// Takes samples in order of stamp.
class DirectionCheck {
 public:
  /// @param rest_speed_mps wheels slower than this are at rest
  explicit DirectionCheck(double rest_speed_mps) : rest_speed_mps_(rest_speed_mps) {}

  void push(const ImuSample& sample);
  void push(const WheelMotion& wheels);

  /// The last start was in opposite directions.
  bool contradicts() const { return contradicts_; }
  /// The wheels have reported a negative speed at some time: their speed has a sign.
  bool hasSign() const { return has_sign_; }

 private:
  enum class Phase { kMoving, kAtRest, kStarting };

  void begin(Nanoseconds stamp);
  void integrate(const ImuSample& sample);
  void judge();

  double rest_speed_mps_;
  Phase phase_ = Phase::kMoving;
  std::deque<ImuSample> rest_;  ///< the newest samples at rest
  Nanoseconds rest_since_ = 0;
  ImuSample reference_;  ///< mean at rest before the start
  Nanoseconds start_ = 0;
  Nanoseconds integrated_until_ = 0;
  Quaternion q_b_to_rest_ = Quaternion::Identity();
  Vector3 velocity_ = Vector3::Zero();  ///< in the body axes at rest [m/s]
  double wheel_speed_mps_ = 0.0;
  bool contradicts_ = false;
  bool has_sign_ = false;
};

}  // namespace slipnav
