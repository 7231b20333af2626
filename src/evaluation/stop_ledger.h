#pragma once
/// Which standstills a drive offered, by its sensors alone, and which of them the filter used.
///
/// The filter's own account (findStops()) lacks the stops it did not recognize; a drive is judged by all.

#include <cstdint>
#include <optional>
#include <vector>

#include "evaluation/motion.h"
#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/stationary_detector.h"

namespace slipnav {

/// A shorter standstill is no stop.
inline constexpr double kShortestStop_s = 1.5;

/// Standstills between motion.
struct StopCounts {
  std::int64_t seen = 0;  ///< wheels and IMU at rest for 1.5 s or more
  std::int64_t used = 0;  ///< of these, with a zero-velocity update that was accepted
};

/// Follows wheels and raw IMU samples in order of stamp.
///
/// Wheels at rest are a standstill if the IMU is quieter than usual while the wheels turn (half of the median
/// spread of the angular rate, which contains no bias), or if the stationary detector agrees. If all wheels of a
/// moving rover fail, that is therefore not a stop.
class StopLedger {
 public:
  StopLedger(const StationaryParams& stationary, const ImuFloor& floor, double gravity_mps2);

  void add(const ImuSample& sample);
  void add(const WheelMotion& wheels);
  /// The filter has accepted a zero-velocity update at `stamp`.
  void noteZeroUpdate(Nanoseconds stamp) { zero_updates_.push_back(stamp); }

  /// Of the drive between two stamps. Standing before the first and after the last motion is not a stop.
  StopCounts counts(Nanoseconds from, Nanoseconds to) const;

 private:
  /// Spread of the angular rate about its mean.
  struct Spread {
    double count = 0.0;
    Vector3 sum = Vector3::Zero();
    double sum_square = 0.0;
    void add(const Vector3& rate);
    double variance() const;
  };
  struct WheelRest {
    Stop time;
    Spread rate;
    bool detected = false;  ///< by the stationary detector, too
  };

  void noteMotion(Nanoseconds stamp);
  bool isStandstill(const WheelRest& rest, double driving_variance) const;

  double rest_speed_mps_;
  double gravity_mps2_;
  StationaryDetector detector_;
  std::vector<WheelRest> rests_;  ///< each between two motions
  std::optional<WheelRest> open_;
  Spread driving_;
  Nanoseconds driving_since_ = 0;
  bool has_moved_ = false;
  std::vector<double> driving_variances_;
  std::vector<Nanoseconds> zero_updates_;
};

}  // namespace slipnav
