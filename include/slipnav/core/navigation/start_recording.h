#pragma once
/// Sensor samples kept while looking for a start, and the standstill in them.

#include <optional>
#include <vector>

#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/models/gnss_fix.h"
#include "slipnav/core/ekf/stationary_detector.h"

namespace slipnav {

/// A period of standstill, between stamps of wheel samples.
struct Rest {
  Nanoseconds begin = 0;  ///< 0: there was none
  Nanoseconds end = 0;
  bool over = false;  ///< the vehicle has moved on
};

/// Keeps samples from the newest sufficiently long standstill on, or the newest ones.
class StartRecording {
 public:
  /// @param gravity_mps2 approximate local value
  /// @param min_rest_s a shorter standstill is discarded; @param max_rest_s the end of a longer one is kept
  /// @param accel_bias_b, gyro_bias_b prior biases: a bias is not motion
  StartRecording(const StationaryParams& stationary, const ImuFloor& floor, double gravity_mps2, double min_rest_s,
                 double max_rest_s, const Vector3& accel_bias_b = Vector3::Zero(),
                 const Vector3& gyro_bias_b = Vector3::Zero());

  void clear();
  void retune(const StationaryParams& stationary) { detector_.retune(stationary); }

  /// Samples in order of stamp, of all sensors together; one that is not finite or not later is dropped.
  void push(const ImuSample& sample);
  void push(const WheelMotion& wheels);
  void push(const AntennaFix& fix);

  const std::vector<ImuSample>& imu() const { return imu_; }
  const std::vector<WheelMotion>& wheels() const { return wheels_; }
  const std::vector<PositionFix>& fixes() const { return fixes_; }
  const std::vector<VelocityFix>& velocityFixes() const { return velocity_fixes_; }
  const Rest& rest() const { return rest_; }
  bool restIsLongEnough() const { return isLongEnough(rest_); }

  /// Stamp of the first IMU sample at or after `stamp`.
  std::optional<Nanoseconds> firstImuStampFrom(Nanoseconds stamp) const;
  /// Likewise, of a sample that is followed by another one within `window_s`.
  std::optional<Nanoseconds> windowBeginFrom(Nanoseconds stamp, double window_s) const;
  /// Mean specific force and rate of the IMU samples later than `begin`, up to `end`; zero if there are none.
  ImuSample mean(Nanoseconds begin, Nanoseconds end) const;
  /// [m/s] of the wheel sample whose interval contains `stamp`, or the last one.
  double speedAt(Nanoseconds stamp) const;

 private:
  bool isLongEnough(const Rest& rest) const { return toSeconds(rest.end - rest.begin) >= min_rest_s_; }
  void trackRest(const WheelMotion& wheels);
  void trackNextRest(bool at_rest, Nanoseconds stamp);
  void forgetOld();
  void forgetBefore(Nanoseconds stamp);
  void dropBefore(Nanoseconds stamp);

  double gravity_mps2_;
  double min_rest_s_;
  double max_rest_s_;
  Vector3 accel_bias_b_;
  Vector3 gyro_bias_b_;
  StationaryDetector detector_;
  std::vector<ImuSample> imu_;
  std::vector<WheelMotion> wheels_;
  std::vector<PositionFix> fixes_;
  std::vector<VelocityFix> velocity_fixes_;
  Rest rest_;
  Rest next_;  ///< a standstill after rest_, not yet long enough to replace it
};

}  // namespace slipnav
