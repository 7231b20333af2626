#pragma once
/// Problems of sensors and filter, by name: the same wording for diagnostics, logs and the fault campaign.

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "slipnav/core/ekf/engine/filter_engine.h"
#include "slipnav/core/ordering/imu_clock.h"
#include "slipnav/core/sensors/imu_screen.h"

namespace slipnav {

/// When a problem was present, in stamps.
struct Alarm {
  Nanoseconds first = 0;
  Nanoseconds last = 0;
  std::uint64_t count = 0;
};

using Alarms = std::map<std::string, Alarm>;

/// Keeps an alarm for each problem seen.
class HealthMonitor {
 public:
  /// @param setup names the wheels and gives how long they may be silent
  explicit HealthMonitor(const FilterSetup& setup);

  void noteImu(Nanoseconds stamp, ImuVerdict verdict);
  /// Problems with the IMU stamps up to `stamp`.
  void noteStamps(const StampFaults& faults, Nanoseconds stamp);
  /// The clock was set back by this much.
  void noteSetBack(double step_s, Nanoseconds stamp);
  /// @param taken whether the filter could use it
  void noteWheels(const WheelMotion& wheels, bool taken);
  /// Checks for rejected measurements, an estimate that ran away, silent wheels, wheels that contradict the others, and
  /// wheels that turn backwards.
  void noteFilter(const FilterEngine& filter);
  /// Any other problem at `stamp`.
  void note(const std::string& name, Nanoseconds stamp);
  /// A problem with a magnitude: one alarm, which reports the largest so far.
  /// @param name start of the alarm's name; @param size in `unit`
  void noteSized(const std::string& name, double size, const std::string& unit, Nanoseconds stamp);
  /// The clock has gone back.
  void restart() { newest_wheels_ = against_since_ = 0; }

  /// All alarms so far.
  const Alarms& alarms() const { return alarms_; }

 private:
  void noteSilence(Nanoseconds now);
  void noteDirection(const NavigationState& state);
  void noteRejections(const FilterEngine& filter);

  double max_wheel_interval_s_;
  std::vector<std::string> wheel_names_;
  std::array<std::uint64_t, kComponents> rejected_ = {};  ///< at the last check of the filter
  Nanoseconds newest_wheels_ = 0;
  double wheel_speed_mps_ = 0.0;        ///< forward, of the newest wheel sample
  Nanoseconds against_since_ = 0;       ///< wheels and vehicle go opposite ways; 0: they do not
  std::uint64_t recoveries_ = 0;        ///< at the last check
  std::uint64_t unexpected_slips_ = 0;  ///< likewise
  StampFaults stamp_faults_;            ///< as last noted
  std::map<std::string, double> sizes_;
  Alarms alarms_;
};

}  // namespace slipnav
