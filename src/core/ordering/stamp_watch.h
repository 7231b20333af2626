#pragma once
/// Sensors whose clocks disagree, judged by the order in which their messages arrive.
///
/// A message arrives soon after it was stamped. So the stamp of any sensor is close to that of the latest IMU
/// message. If it differs by more than any transport takes, always by the same amount, the clocks disagree.

#include <map>
#include <string>
#include <utility>

#include "slipnav/core/base/types.h"

namespace slipnav {

/// "stamps of A and B are 3.1 s apart", and a likely cause if there is one.
std::string clocksApart(const std::string& a, const std::string& b, double apart_s);

/// For alarms only: its result depends on the order of arrival.
class StampWatch {
 public:
  explicit StampWatch(std::string imu_topic) : imu_topic_(std::move(imu_topic)) {}

  void noteImu(Nanoseconds stamp) { newest_imu_ = stamp; }

  /// A message of another sensor has arrived.
  /// @return what is wrong with its clock, repeated every few messages; otherwise ""
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
