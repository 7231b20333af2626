#include "overlay/wheel_path.h"

#include <cmath>
#include <limits>
#include <utility>

namespace slipnav {
namespace {

/// How long before the newest sample an estimate may start.
constexpr Nanoseconds kHeldBack = 60'000'000'000;

template <class Sample>
bool wentBack(const std::deque<Sample>& held, Nanoseconds stamp) {
  return !held.empty() && stamp <= held.back().stamp - kRestartBackstep;
}

}  // namespace

void WheelPath::clear() { *this = WheelPath(); }

void WheelPath::start(const PlanarSample& pose) {
  if (started_) {
    return;
  }
  reckoning_.start(pose);
  started_ = true;
  release(std::numeric_limits<Nanoseconds>::max());
}

void WheelPath::add(const ImuSample& imu) {
  if (!imu.omega_ib_b.allFinite()) {
    return;
  }
  if (wentBack(imu_, imu.stamp)) {
    clear();
  }
  imu_.push_back(imu);
  release(started_ ? imu.stamp : imu.stamp - kHeldBack);
}

void WheelPath::add(const SpeedSample& speed) {
  if (!std::isfinite(speed.forward_mps)) {
    return;
  }
  if (wentBack(speeds_, speed.stamp)) {
    clear();
  }
  speeds_.push_back(speed);
  release(started_ ? speed.stamp : speed.stamp - kHeldBack);
}

/// The newest sample of each kind stays, so that a clock that goes back is noticed.
void WheelPath::release(Nanoseconds until) {
  while (imu_.size() > 1 && imu_.front().stamp <= until) {
    reckoning_.addImu(imu_.front());
    imu_.pop_front();
  }
  while (speeds_.size() > 1 && speeds_.front().stamp <= until) {
    reckoning_.addSpeed(speeds_.front());
    speeds_.pop_front();
  }
}

PlanarTrack WheelPath::take() { return started_ ? reckoning_.takeTrack() : PlanarTrack(); }

}  // namespace slipnav
