#include "evaluation/planar_dead_reckoning.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace slipnav {

PlanarDeadReckoning::PlanarDeadReckoning(const PlanarOptions& options) : options_(options) {}

void PlanarDeadReckoning::start(const PlanarSample& pose) {
  if (!track_.empty()) {
    throw std::logic_error("planar dead reckoning has started already");
  }
  track_.push_back(pose);
}

bool PlanarDeadReckoning::addImu(const ImuSample& imu) {
  if (last_imu_ && imu.stamp <= *last_imu_) {
    return false;
  }
  if (last_imu_) {
    turns_.push_back({*last_imu_, imu.stamp, imu.omega_ib_b.z()});
  }
  last_imu_ = imu.stamp;
  processReady();
  return true;
}

bool PlanarDeadReckoning::addSpeed(const SpeedSample& speed) {
  if (last_speed_ && speed.stamp <= *last_speed_) {
    return false;
  }
  last_speed_ = speed.stamp;
  speeds_.push_back(speed);
  processReady();
  return true;
}

PlanarTrack PlanarDeadReckoning::takeTrack() {
  PlanarTrack taken;
  taken.swap(track_);
  if (!taken.empty()) {
    track_.push_back(taken.back());
  }
  return taken;
}

double PlanarDeadReckoning::gyroBias() const {
  return standstill_s_ >= options_.min_standstill_s ? standstill_angle_rad_ / standstill_s_ : 0.0;
}

void PlanarDeadReckoning::processReady() {
  while (!speeds_.empty() && last_imu_ && *last_imu_ >= speeds_.front().stamp) {
    const SpeedSample speed = speeds_.front();
    speeds_.pop_front();
    const std::vector<Turn> turns = takeTurnsUntil(speed.stamp);
    has_moved_ = has_moved_ || std::abs(speed.forward_mps) > options_.standstill_speed_mps;
    if (!has_moved_) {
      collectBias(turns);
    }
    integrate(turns, speed);
  }
}

std::vector<PlanarDeadReckoning::Turn> PlanarDeadReckoning::takeTurnsUntil(Nanoseconds stamp) {
  std::vector<Turn> taken;
  while (!turns_.empty() && turns_.front().begin < stamp) {
    Turn& turn = turns_.front();
    taken.push_back({turn.begin, std::min(turn.end, stamp), turn.rate_radps});
    if (turn.end > stamp) {
      turn.begin = stamp;
      break;
    }
    turns_.pop_front();
  }
  return taken;
}

void PlanarDeadReckoning::collectBias(const std::vector<Turn>& turns) {
  for (const Turn& turn : turns) {
    const double dt_s = toSeconds(turn.end - turn.begin);
    standstill_s_ += dt_s;
    standstill_angle_rad_ += turn.rate_radps * dt_s;
  }
}

void PlanarDeadReckoning::integrate(const std::vector<Turn>& turns, const SpeedSample& speed) {
  if (track_.empty() || speed.stamp <= track_.back().stamp) {
    return;
  }
  PlanarSample pose = track_.back();
  for (const Turn& turn : turns) {
    const double dt_s = toSeconds(turn.end - std::max(turn.begin, pose.stamp));
    if (dt_s <= 0.0 || !has_moved_) {
      continue;
    }
    const double turned_rad = (turn.rate_radps - gyroBias()) * dt_s;
    const double direction_rad = pose.heading_rad + 0.5 * turned_rad;
    pose.east_m += speed.forward_mps * dt_s * std::sin(direction_rad);
    pose.north_m += speed.forward_mps * dt_s * std::cos(direction_rad);
    pose.heading_rad += turned_rad;
  }
  pose.stamp = speed.stamp;
  track_.push_back(pose);
}

}  // namespace slipnav
