#pragma once
/// Sensors whose clocks do not agree, told by the order in which their messages come.
///
/// A message comes soon after it was stamped. So the stamp of any sensor is about that of the IMU message that came
/// last. Where it differs by more than any transport takes, always by the same, the clocks are apart.

#include <map>
#include <string>
#include <utility>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// "stamps of A and B are 3.1 s apart", and a guess at the cause where there is one.
std::string clocksApart(const std::string& a, const std::string& b, double apart_s);

/// For alarms only: what it says depends on the order of arrival.
class StampWatch {
 public:
  explicit StampWatch(std::string imu_topic) : imu_topic_(std::move(imu_topic)) {}

  void noteImu(Nanoseconds stamp) { newest_imu_ = stamp; }

  /// A message of another sensor has come.
  /// @return what is wrong with its clock, said again every few messages; "" mostly
  std::string note(const std::string& topic, Nanoseconds stamp);

 private:
  /// How the newest messages of one sensor differ from the IMU.
  struct Window {
    int count = 0;
    double least_s = 0.0;
    double greatest_s = 0.0;
  };

  std::string imu_topic_;
  Nanoseconds newest_imu_ = 0;
  std::map<std::string, Window> windows_;
};

}  // namespace slipnav
