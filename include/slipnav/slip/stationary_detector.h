#pragma once
/// Is the rover standing still? Encoders and the IMU have to say so both; the innovation gate has the last word later.
///
/// The IMU's part is the likelihood-ratio test SHOE (Skog, Händel, Nilsson, Rantakokko 2010, eq. 23): over a window,
/// the specific force must equal gravity in one constant direction and the angular rate must vanish.

#include <cstddef>
#include <vector>

#include "slipnav/config/parameter_visitor.h"
#include "slipnav/types.h"

namespace slipnav {

/// Block `stationary`.
struct StationaryParams {
  double window_s = 0.3;
  double hold_off_s = 0.2;
  double wheel_speed_mps = 0.0005;
  double accel_std_mps2 = 0.05;
  double gyro_std_deg_per_s = 0.3;
  double shoe_threshold = 6.0;
  void visit(ParameterVisitor& v);
};

/// Keeps the IMU steps of the test window, and since when the wheels have been at rest.
class StationaryDetector {
 public:
  explicit StationaryDetector(const StationaryParams& params);

  /// Forgets everything.
  void reset();

  /// Other limits from now on; the samples so far stay.
  void retune(const StationaryParams& params) { params_ = params; }

  /// Bias-free mean specific force and rate of one IMU step that ends at `stamp`.
  void addImu(Nanoseconds stamp, const Vector3& f_ib_b, const Vector3& omega_ib_b);

  /// Largest circumferential speed of any wheel over the interval that ends at `stamp`.
  void addWheels(Nanoseconds stamp, double largest_speed_mps);

  /// True when wheels and IMU have agreed on rest for the hold-off time, as of the last wheel sample.
  /// @param gravity_mps2 magnitude of the local gravity
  bool isStationary(double gravity_mps2) const;

  /// Test statistic of the IMU over the window; about 6 for noise of exactly the given deviations, infinite while the
  /// window is not filled.
  double shoeStatistic(double gravity_mps2) const;

  bool wheelsAtRest() const { return wheels_at_rest_; }

 private:
  struct Sample {
    Nanoseconds stamp;
    Vector3 f_ib_b;
    double rate2;
  };

  StationaryParams params_;
  std::vector<Sample> ring_;  ///< the last samples, newest at head_ − 1
  std::size_t head_ = 0;
  std::size_t size_ = 0;
  bool wheels_at_rest_ = false;
  Nanoseconds wheels_at_rest_since_ = 0;
  Nanoseconds last_wheels_ = 0;
};

}  // namespace slipnav
