#pragma once
/// Errors of the IMU, the wheel encoders and the GNSS receivers.

#include "simulation/inertial_truth.h"
#include "simulation/params.h"
#include "simulation/random.h"
#include "slipnav/core/base/sensors.h"
#include "slipnav/core/earth/local_frame.h"

namespace slipnav::sim {

/// Regular sampling instants of one sensor, as stamps.
class SampleClock {
 public:
  SampleClock(Nanoseconds start, double rate_hz) : start_(start), rate_hz_(rate_hz) {}

  Nanoseconds next() const { return start_ + fromSeconds(static_cast<double>(index_) / rate_hz_); }
  void advance() { ++index_; }

 private:
  Nanoseconds start_;
  double rate_hz_;
  std::int64_t index_ = 1;
};

/// Stamps of a host that reads samples late, irregularly, or several at once. In the order of the samples.
class HostClock {
 public:
  HostClock(const HostStampParams& params, double rate_hz, std::uint64_t seed, std::string_view purpose);

  /// The stamp of the next sample, whose true instant is given.
  Nanoseconds stamp(Nanoseconds instant);

 private:
  HostStampParams params_;
  double interval_s_;
  RandomStream stream_;
  Nanoseconds last_ = 0;
  int in_burst_ = 0;
};

/// Noise, turn-on and in-run biases, scale factors, misalignment.
class ImuModel {
 public:
  ImuModel(const ImuParams& params, std::uint64_t seed);

  /// @param mean what an ideal sensor along body axes senses over the interval
  ImuSample measure(const InertialMean& mean, Nanoseconds stamp, double dt_s);

  const Vector3& accelBias() const { return accel_.bias; }  ///< [m/s²]
  const Vector3& gyroBias() const { return gyro_.bias; }    ///< [rad/s]

 private:
  /// The errors of three axes of one kind, SI.
  struct Triad {
    double noise_density = 0.0;  ///< per √Hz
    double in_run_sigma = 0.0;
    Vector3 scale = Vector3::Zero();
    Vector3 turn_on_bias = Vector3::Zero();
    double walk_density = 0.0;
    Vector3 in_run_bias = Vector3::Zero();
    Vector3 walk = Vector3::Zero();
    Vector3 bias = Vector3::Zero();  ///< sum of the three
  };
  void turnOn(Triad& triad, double turn_on_sigma, double scale_sigma);
  Vector3 corrupt(Triad& triad, const Vector3& value, double dt_s);

  ImuParams params_;
  Matrix3 C_b_to_s_;  ///< true mounting: body to sensor axes
  RandomStream stream_;
  RandomStream walk_stream_;
  Triad accel_;
  Triad gyro_;
};

/// Quantized wheel angles and the mean rates between them.
class EncoderModel {
 public:
  /// @param wheels 2, 4 or 6
  EncoderModel(const EncoderParams& params, Nanoseconds start, std::uint64_t seed, std::size_t wheels = kWheelCount);

  WheelSample measure(const PerWheel& angle_rad, Nanoseconds stamp);
  /// Quantized angles of the last sample, from zero at the start [rad].
  const EncoderAngles& angles() const { return last_angle_rad_; }

 private:
  double quantize(double angle_rad, std::size_t wheel) const;
  bool isDead(std::size_t wheel, Nanoseconds stamp) const;
  EncoderAngles ofLayout(const PerWheel& angle_rad) const;

  EncoderParams params_;
  std::size_t count_;
  double count_rad_;
  EncoderAngles offset_counts_ = {};  ///< position of each wheel within a count at the start
  EncoderAngles last_angle_rad_ = {};
  Nanoseconds start_;
  Nanoseconds last_stamp_;
};

/// White-noise fixes of an antenna.
class GnssModel {
 public:
  GnssModel(const GnssParams& params, const LocalFrame& frame, std::uint64_t seed, std::string_view purpose);

  GnssFix measure(const Vector3& position_enu_m, const Matrix3& C_b_to_enu, Nanoseconds stamp);

 private:
  GnssParams params_;
  Vector3 error(Nanoseconds stamp);

  LocalFrame frame_;
  RandomStream stream_;
  RandomStream outliers_;
  Vector3 normal_ = Vector3::Zero();  ///< error of the last fix in standard deviations
  Nanoseconds newest_ = 0;
};

}  // namespace slipnav::sim
