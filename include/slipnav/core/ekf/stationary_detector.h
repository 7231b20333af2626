#pragma once
/// Is the rover standing still? Encoders and IMU must both say so.
///
/// The IMU test follows Skog, Händel, Nilsson, Rantakokko (2010): over a window, specific force and angular rate must
/// not scatter more than at rest, about their own means, so that no bias matters; the means must be gravity and
/// zero, within the sensor's biases. The scatter of this rover's IMU at rest and while driving
/// (engine, fans, vibration) is learned, so that nothing depends on a particular sensor.

#include <cstddef>
#include <vector>

#include "slipnav/core/base/types.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Block `stationary`.
struct StationaryParams {
  double window_s = 0.4;
  double hold_off_s = 0.2;
  double wheel_speed_mps = 0.0005;
  double accel_std_mps2 = 0.05;
  double gyro_std_deg_per_s = 0.3;
  void visit(ParameterVisitor& v);
};

/// The sensor's data sheet in SI units.
struct ImuFloor {
  double accel_density = 0.0;   ///< [m²/s³]
  double gyro_density = 0.0;    ///< [rad²/s]
  double accel_bias_std = 0.0;  ///< [m/s²]
  double gyro_bias_std = 0.0;   ///< [rad/s]
};

/// Keeps the IMU steps of the test window, the time since the wheels came to rest, and what rest and driving look
/// like.
class StationaryDetector {
 public:
  StationaryDetector(const StationaryParams& params, const ImuFloor& floor);

  /// Forgets everything.
  void reset();

  /// Other limits from now on; the samples so far stay.
  void retune(const StationaryParams& params) { params_ = params; }

  /// Mean specific force and rate of one IMU step that ends at `stamp`, biases included.
  void addImu(Nanoseconds stamp, const Vector3& f_ib_b, const Vector3& omega_ib_b);

  /// Largest circumferential speed of any wheel over the interval that ends at `stamp`.
  /// @param noise_std_mps learned 1σ of that speed
  void addWheels(Nanoseconds stamp, double largest_speed_mps, double noise_std_mps = 0.0);

  /// True when wheels and IMU have agreed on rest for the hold-off time, as of the last wheel sample. Learns from it.
  /// @param gravity_mps2 magnitude of the local gravity
  /// @param drives whether turning wheels drive the rover; spinning in place does not show what driving feels like
  bool judge(double gravity_mps2, bool drives = true);

  bool wheelsAtRest() const { return wheels_at_rest_; }

  /// Whether the means of specific force and rate are those of rest, whatever the wheels say.
  bool hasLevelOfRest(double gravity_mps2) const;
  /// Whether the IMU is clearly calmer now than in the last seconds of driving.
  /// @param was whether it was so before: staying so takes less
  bool isCalmerThanDriving(bool was) const;

  /// Means over the window; only after a sample.
  struct Window {
    Vector3 f_ib_b = Vector3::Zero();
    Vector3 omega_ib_b = Vector3::Zero();
    double accel_variance = 0.0;  ///< scatter about the mean, per axis [m²/s⁴]
    double gyro_variance = 0.0;   ///< [rad²/s²]
    double period_s = 0.0;        ///< mean time between samples
    bool filled = false;
  };
  Window window() const;

 private:
  struct Sample {
    Nanoseconds stamp;
    Vector3 f_ib_b;
    Vector3 omega_ib_b;
  };

  /// Scatter per axis of both triads, and the time it is averaged over.
  struct Level {
    double accel_variance = 0.0;
    double gyro_variance = 0.0;
    double time_s = 0.0;
    void add(const Window& window, double interval_s, double memory_s);
  };

  bool scattersLikeRest(const Window& window) const;
  bool meansAreThoseOfRest(const Window& window, double gravity_mps2) const;

  StationaryParams params_;
  ImuFloor floor_;
  std::vector<Sample> ring_;  ///< the last samples, newest at head_ − 1
  std::size_t head_ = 0;
  std::size_t size_ = 0;
  bool wheels_at_rest_ = false;
  Nanoseconds wheels_at_rest_since_ = 0;
  Nanoseconds last_wheels_ = 0;
  Nanoseconds last_judged_ = 0;
  bool has_driven_ = false;
  Level rest_;
  Level drive_;
};

}  // namespace slipnav
