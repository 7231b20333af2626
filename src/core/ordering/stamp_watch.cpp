#include "core/ordering/stamp_watch.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace slipnav {
namespace {

constexpr int kMessages = 16;
/// Longer than messages take to arrive.
constexpr double kApart_s = 0.5;
/// Relative to the difference: a transport delay that long would not be so constant.
constexpr double kEven = 0.2;
/// GPS time is ahead of UTC by this since 2017.
constexpr double kLeapSeconds_s = 18.0;
constexpr double kLeapTolerance_s = 0.5;

}  // namespace

std::string clocksApart(const std::string& a, const std::string& b, double apart_s) {
  std::ostringstream text;
  text << "stamps of " << a << " and " << b << " are " << std::fixed << std::setprecision(1) << std::abs(apart_s)
       << " s apart"
       << (std::abs(std::abs(apart_s) - kLeapSeconds_s) < kLeapTolerance_s ? ": is one of them GPS time?" : "");
  return text.str();
}

std::string StampWatch::note(const std::string& topic, Nanoseconds stamp) {
  if (newest_imu_ <= 0 || stamp <= 0) {
    return "";
  }
  const double difference_s = toSeconds(stamp - newest_imu_);
  Window& window = windows_[topic];
  window.least_s = window.count == 0 ? difference_s : std::min(window.least_s, difference_s);
  window.greatest_s = window.count == 0 ? difference_s : std::max(window.greatest_s, difference_s);
  if (++window.count < kMessages) {
    return "";
  }
  const double apart_s = std::abs(0.5 * (window.least_s + window.greatest_s));
  const double span_s = window.greatest_s - window.least_s;
  window = Window();
  if (apart_s < kApart_s || span_s > kEven * apart_s) {
    return "";
  }
  return clocksApart(imu_topic_, topic, apart_s);
}

}  // namespace slipnav
