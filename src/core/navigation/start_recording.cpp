#include "slipnav/core/navigation/start_recording.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace slipnav {
namespace {

/// [s] of driving after a rest in which a start has to be found.
constexpr double kLongestDrive_s = 300.0;
constexpr Nanoseconds kForgetAtOnce = 10 * kSecond;

}  // namespace

StartRecording::StartRecording(const StationaryParams& stationary, const ImuFloor& floor, double gravity_mps2,
                               double min_rest_s, double max_rest_s, const Vector3& accel_bias_b,
                               const Vector3& gyro_bias_b)
    : gravity_mps2_(gravity_mps2),
      min_rest_s_(min_rest_s),
      max_rest_s_(max_rest_s),
      accel_bias_b_(accel_bias_b),
      gyro_bias_b_(gyro_bias_b),
      detector_(stationary, floor) {}

void StartRecording::clear() {
  detector_.reset();
  imu_.clear();
  wheels_.clear();
  fixes_.clear();
  velocity_fixes_.clear();
  rest_ = next_ = Rest{};
}

void StartRecording::push(const ImuSample& sample) {
  if (!sample.f_ib_b.allFinite() || !sample.omega_ib_b.allFinite() ||
      (!imu_.empty() && sample.stamp <= imu_.back().stamp)) {
    return;
  }
  imu_.push_back(sample);
  detector_.addImu(sample.stamp, sample.f_ib_b - accel_bias_b_, sample.omega_ib_b - gyro_bias_b_);
  forgetOld();
}

void StartRecording::push(const WheelMotion& wheels) {
  if (!std::isfinite(wheels.motion.forward_mps) || (!wheels_.empty() && wheels.stamp <= wheels_.back().stamp)) {
    return;
  }
  wheels_.push_back(wheels);
  trackRest(wheels);
}

void StartRecording::push(const AntennaFix& fix) {
  const auto append = [](const auto& next, auto& fixes) {
    if (isFinite(next) && (fixes.empty() || next.stamp > fixes.back().stamp)) {
      fixes.push_back(next);
    }
  };
  if (const auto* position = std::get_if<PositionFix>(&fix)) {
    append(*position, fixes_);
  } else {
    append(std::get<VelocityFix>(fix), velocity_fixes_);
  }
}

void StartRecording::trackRest(const WheelMotion& wheels) {
  detector_.addWheels(wheels.stamp, wheels.largest_speed_mps);
  const bool at_rest = detector_.judge(gravity_mps2_);
  if (at_rest && !rest_.over) {
    if (rest_.begin == 0) {
      rest_.begin = wheels.stamp;
    }
    rest_.end = wheels.stamp;
    forgetBefore(rest_.end - fromSeconds(max_rest_s_));
  } else if (!at_rest && rest_.begin != 0 && !rest_.over) {
    if (restIsLongEnough()) {
      rest_.over = true;
    } else {
      rest_ = Rest{};
    }
  }
  if (rest_.over) {
    trackNextRest(at_rest, wheels.stamp);
  }
}

/// The drive after a rest may not have produced a start because fixes were missing: then a later rest counts.
void StartRecording::trackNextRest(bool at_rest, Nanoseconds stamp) {
  if (!at_rest) {
    next_ = Rest{};
    return;
  }
  if (next_.begin == 0) {
    next_.begin = stamp;
  }
  next_.end = stamp;
  if (isLongEnough(next_)) {
    rest_ = std::exchange(next_, Rest{});
    dropBefore(rest_.begin);
  }
}

/// A drive this long without a start is no longer useful.
void StartRecording::forgetOld() {
  const Nanoseconds longest = fromSeconds(max_rest_s_ + kLongestDrive_s);
  if (imu_.back().stamp - imu_.front().stamp <= longest + kForgetAtOnce) {
    return;
  }
  const Nanoseconds begin = imu_.back().stamp - longest;
  if (rest_.begin != 0 && rest_.begin < begin) {
    rest_ = Rest{};
  }
  dropBefore(begin);
}

void StartRecording::forgetBefore(Nanoseconds stamp) {
  if (rest_.begin >= stamp) {
    return;
  }
  rest_.begin = stamp;
  dropBefore(stamp);
}

void StartRecording::dropBefore(Nanoseconds stamp) {
  const auto drop = [stamp](auto& samples) {
    samples.erase(samples.begin(), std::find_if(samples.begin(), samples.end(),
                                                [stamp](const auto& sample) { return sample.stamp >= stamp; }));
  };
  drop(imu_);
  drop(wheels_);
  drop(fixes_);
  drop(velocity_fixes_);
}

std::optional<Nanoseconds> StartRecording::firstImuStampFrom(Nanoseconds stamp) const {
  const auto it = std::find_if(imu_.begin(), imu_.end(), [stamp](const ImuSample& s) { return s.stamp >= stamp; });
  return it == imu_.end() ? std::nullopt : std::optional<Nanoseconds>(it->stamp);
}

std::optional<Nanoseconds> StartRecording::windowBeginFrom(Nanoseconds stamp, double window_s) const {
  const Nanoseconds window = fromSeconds(window_s);
  const auto it = std::adjacent_find(imu_.begin(), imu_.end(), [=](const ImuSample& sample, const ImuSample& next) {
    return sample.stamp >= stamp && next.stamp - sample.stamp <= window;
  });
  return it == imu_.end() ? std::nullopt : std::optional<Nanoseconds>(it->stamp);
}

ImuSample StartRecording::mean(Nanoseconds begin, Nanoseconds end) const {
  ImuSample sum;
  double n = 0.0;
  for (const ImuSample& sample : imu_) {
    if (sample.stamp > begin && sample.stamp <= end) {
      sum.f_ib_b += sample.f_ib_b;
      sum.omega_ib_b += sample.omega_ib_b;
      n += 1.0;
    }
  }
  sum.f_ib_b /= std::max(n, 1.0);
  sum.omega_ib_b /= std::max(n, 1.0);
  return sum;
}

double StartRecording::speedAt(Nanoseconds stamp) const {
  const auto it =
      std::find_if(wheels_.begin(), wheels_.end(), [stamp](const WheelMotion& w) { return w.stamp >= stamp; });
  return it == wheels_.end() ? (wheels_.empty() ? 0.0 : wheels_.back().motion.forward_mps) : it->motion.forward_mps;
}

}  // namespace slipnav
