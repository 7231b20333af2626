#include "evaluation/simulated_judge.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/text.h"
#include "evaluation/simulated_drive.h"
#include "evaluation/stop_ledger.h"

namespace slipnav {
namespace {

/// Per degree of freedom, of three; none if the covariance is not positive definite.
std::optional<double> neesOf(const ErrorVector& error, const ErrorCovariance& P, int index) {
  const Eigen::LLT<Matrix3> factor(P.block<3, 3>(index, index));
  if (factor.info() != Eigen::Success) {
    return std::nullopt;
  }
  const Vector3 e = error.segment<3>(index);
  return e.dot(factor.solve(e)) / 3.0;
}

std::string jsonNumber(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? formatNumber(*value) : "null";
}

std::string alarmsJson(const Alarms& alarms) {
  std::string text;
  for (const auto& [what, alarm] : alarms) {
    text += std::string(text.empty() ? "" : ", ") + "{\"what\": \"" + what +
            "\", \"count\": " + std::to_string(alarm.count) + ", \"first_s\": " + formatNumber(toSeconds(alarm.first)) +
            ", \"last_s\": " + formatNumber(toSeconds(alarm.last)) + "}";
  }
  return "[" + text + "]";
}

}  // namespace

std::string figuresJson(const SimulationFigures& figures) {
  std::ostringstream out;
  out << "{\n  \"nees_end_attitude\": " << jsonNumber(figures.nees_end_attitude)
      << ",\n  \"nees_end_velocity\": " << jsonNumber(figures.nees_end_velocity)
      << ",\n  \"nees_end_position\": " << jsonNumber(figures.nees_end_position)
      << ",\n  \"stops_seen\": " << std::to_string(figures.stops_seen)
      << ",\n  \"stops_used\": " << std::to_string(figures.stops_used)
      << ",\n  \"largest_speed_mps\": " << jsonNumber(figures.largest_speed_mps)
      << ",\n  \"largest_wheel_speed_mps\": " << jsonNumber(figures.largest_wheel_speed_mps)
      << ",\n  \"largest_error_m\": " << jsonNumber(figures.largest_error_m)
      << ",\n  \"longest_beyond_3sigma_s\": " << jsonNumber(figures.longest_beyond_3sigma_s)
      << ",\n  \"alarms\": " << alarmsJson(figures.alarms) << "\n}\n";
  return out.str();
}

void SimulatedJudge::addTruth(Nanoseconds imu_stamp, const sim::TruthState& truth) {
  truths_.push_back({imu_stamp, truth});
  for (std::size_t i = 0; i < sim::kWheelCount; ++i) {
    figures_.largest_wheel_speed_mps =
        std::max(figures_.largest_wheel_speed_mps, std::abs(truth.wheel_rate_radps[i] * truth.wheel_radius_m[i]));
  }
}

/// A navigation that corrects stamps gives its estimates different ones than the samples had: the nearest is meant.
const sim::TruthState* SimulatedJudge::truthAt(Nanoseconds imu_stamp) {
  const auto distance = [imu_stamp](const StampedTruth& truth) { return std::abs(truth.imu_stamp - imu_stamp); };
  while (truths_.size() > 1 && distance(truths_[1]) <= distance(truths_[0])) {
    truths_.pop_front();
  }
  return truths_.empty() ? nullptr : &truths_.front().truth;
}

void SimulatedJudge::compare(const Estimate& estimate, const ErrorCovariance& P) {
  const sim::TruthState* truth = truthAt(estimate.nav.stamp);
  if (truth == nullptr) {
    return;
  }
  const ErrorVector error = errorBetween(planet_, estimate.nav, toNavState(*truth, planet_, imu_position_b_));
  figures_.largest_speed_mps = std::max(figures_.largest_speed_mps, estimate.nav.v_eb_n.norm());
  if (truth->distance_m < route_end_m_) {
    figures_.nees_end_attitude = neesOf(error, P, kAttitude);
    figures_.nees_end_velocity = neesOf(error, P, kVelocity);
    figures_.nees_end_position = neesOf(error, P, kPosition);
  }
  followErrors(truth->stamp, error, P);
  followStops(*truth, estimate.stationary);
}

void SimulatedJudge::followErrors(Nanoseconds stamp, const ErrorVector& error, const ErrorCovariance& P) {
  const Vector3 position = error.segment<3>(kPosition);
  const Vector3 bound = 3.0 * P.diagonal().segment<3>(kPosition).cwiseMax(0.0).cwiseSqrt();
  figures_.largest_error_m = std::max(figures_.largest_error_m, position.norm());
  if ((position.cwiseAbs().array() <= bound.array()).all()) {
    beyond_since_.reset();
    return;
  }
  beyond_since_ = beyond_since_.value_or(stamp);
  figures_.longest_beyond_3sigma_s = std::max(figures_.longest_beyond_3sigma_s, toSeconds(stamp - *beyond_since_));
}

void SimulatedJudge::followStops(const sim::TruthState& truth, bool stationary) {
  if (truth.standstill) {
    rest_since_ = rest_since_.value_or(truth.stamp);
    rest_used_ = rest_used_ || stationary;
    return;
  }
  if (has_moved_ && rest_since_ && toSeconds(truth.stamp - *rest_since_) >= kShortestStop_s) {
    ++figures_.stops_seen;
    figures_.stops_used += rest_used_ ? 1 : 0;
  }
  has_moved_ = true;
  rest_since_.reset();
  rest_used_ = false;
}

}  // namespace slipnav
