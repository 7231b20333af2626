#include "ros/messages/internal_messages.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "ros/messages/conversions.h"

namespace slipnav {

// Structs are taken apart member by member, so that one that gains a member does not compile until it is sent too.

namespace {

template <class Array>
void copyVector(const Vector3& v, Array& array) {
  std::copy(v.data(), v.data() + 3, array.begin());
}

template <class Array>
Vector3 vectorOf(const Array& array) {
  return {array[0], array[1], array[2]};
}

static_assert(StartState::_covariance_type::static_size == kErrorStates * kErrorStates);
using RowMajorCovariance = Eigen::Matrix<double, kErrorStates, kErrorStates, Eigen::RowMajor>;

}  // namespace

InertialState toMessage(const NavigationState& state) {
  const auto& [stamp, q_b_to_n, v_eb_n, position, accel_bias_b, gyro_bias_b] = state;
  InertialState message;
  message.stamp = toRosTime(stamp);
  message.q_b_to_n = {q_b_to_n.w(), q_b_to_n.x(), q_b_to_n.y(), q_b_to_n.z()};
  copyVector(v_eb_n, message.v_eb_n);
  message.latitude_rad = position.latitude_rad;
  message.longitude_rad = position.longitude_rad;
  message.height_m = position.height_m;
  copyVector(accel_bias_b, message.accel_bias_b);
  copyVector(gyro_bias_b, message.gyro_bias_b);
  return message;
}

NavigationState fromMessage(const InertialState& message) {
  NavigationState state;
  state.stamp = toNanoseconds(message.stamp);
  state.q_b_to_n = Quaternion(message.q_b_to_n[0], message.q_b_to_n[1], message.q_b_to_n[2], message.q_b_to_n[3]);
  state.v_eb_n = vectorOf(message.v_eb_n);
  state.position = {message.latitude_rad, message.longitude_rad, message.height_m};
  state.accel_bias_b = vectorOf(message.accel_bias_b);
  state.gyro_bias_b = vectorOf(message.gyro_bias_b);
  return state;
}

InsInterval toMessage(const InsStep& step) {
  const auto& [sequence, epoch, start, state, f_ib_b, omega_ib_b, gap_s] = step;
  static_cast<void>(epoch);  // of the whole batch
  InsInterval message;
  message.sequence = sequence;
  message.start = toRosTime(start);
  message.state = toMessage(state);
  copyVector(f_ib_b, message.f_ib_b);
  copyVector(omega_ib_b, message.omega_ib_b);
  message.gap_s = gap_s;
  return message;
}

InsStep fromMessage(const InsInterval& message, std::uint32_t epoch) {
  InsStep step;
  step.sequence = message.sequence;
  step.epoch = epoch;
  step.start = toNanoseconds(message.start);
  step.state = fromMessage(message.state);
  step.f_ib_b = vectorOf(message.f_ib_b);
  step.omega_ib_b = vectorOf(message.omega_ib_b);
  step.gap_s = message.gap_s;
  return step;
}

void fill(const ContinuousTime& time, InsSteps& message) {
  for (const ClockStep& step : time.steps()) {
    message.clock_step_begin.push_back(toRosTime(step.begin));
    message.clock_step_offset.push_back(step.offset);
  }
}

ContinuousTime timeOf(const InsSteps& message) {
  std::vector<ClockStep> steps;
  for (std::size_t i = 0; i < message.clock_step_begin.size(); ++i) {
    steps.push_back({toNanoseconds(message.clock_step_begin[i]), message.clock_step_offset.at(i)});
  }
  return ContinuousTime(std::move(steps));
}

void fill(const InitialState& initial, StartState& message) {
  const auto& [nav, vehicle, P, origin, tremor_variance] = initial;
  const auto& [wheel_scale, slow_slip, fast_slip, side_slip, mount_pitch_rad, mount_yaw_rad] = vehicle;
  message.known = true;
  message.state = toMessage(nav);
  message.vehicle = {wheel_scale, slow_slip, fast_slip, side_slip, mount_pitch_rad, mount_yaw_rad};
  Eigen::Map<RowMajorCovariance>(message.covariance.data()) = P;
  message.tremor_variance = tremor_variance;
  message.origin_latitude_rad = origin.latitude_rad;
  message.origin_longitude_rad = origin.longitude_rad;
  message.origin_height_m = origin.height_m;
}

InitialState fromMessage(const StartState& message) {
  InitialState initial;
  initial.nav = fromMessage(message.state);
  initial.vehicle = {message.vehicle[0], message.vehicle[1], message.vehicle[2],
                     message.vehicle[3], message.vehicle[4], message.vehicle[5]};
  initial.P = Eigen::Map<const RowMajorCovariance>(message.covariance.data());
  initial.tremor_variance = message.tremor_variance;
  initial.origin = {message.origin_latitude_rad, message.origin_longitude_rad, message.origin_height_m};
  return initial;
}

void fill(const Estimate& estimate, const ErrorCovariance& P, ForecastInput& message) {
  const auto& [wheel_scale, slow_slip, fast_slip, side_slip, mount_pitch_rad, mount_yaw_rad] = estimate.vehicle;
  message.state = toMessage(estimate.nav);
  message.vehicle = {wheel_scale, slow_slip, fast_slip, side_slip, mount_pitch_rad, mount_yaw_rad};
  Eigen::Map<RowMajorCovariance>(message.covariance.data()) = P;
  const auto factors = estimate.noise_factors.toArray();
  std::copy(factors.begin(), factors.end(), message.noise_factors.begin());
  copyVector(estimate.f_ib_b, message.f_ib_b);
  copyVector(estimate.omega_ib_b, message.omega_ib_b);
  message.stationary = estimate.stationary;
  message.wheel_speed_used = estimate.wheel_speed_used;
  message.wheel_stamp = toRosTime(estimate.wheels.stamp);
  message.wheel_speed_mps = estimate.wheels.motion.forward_mps;
  message.duration_s = estimate.motion.duration_s;
  copyVector(estimate.motion.v_eb_b, message.v_eb_b);
}

Estimate estimateOf(const ForecastInput& message) {
  Estimate estimate;
  estimate.nav = fromMessage(message.state);
  estimate.vehicle = {message.vehicle[0], message.vehicle[1], message.vehicle[2],
                      message.vehicle[3], message.vehicle[4], message.vehicle[5]};
  std::array<double, NoiseFactors::kCount> factors = {};
  std::copy(message.noise_factors.begin(), message.noise_factors.end(), factors.begin());
  estimate.noise_factors = NoiseFactors::fromArray(factors);
  estimate.f_ib_b = vectorOf(message.f_ib_b);
  estimate.omega_ib_b = vectorOf(message.omega_ib_b);
  estimate.stationary = message.stationary;
  estimate.has_wheels = true;
  estimate.wheel_speed_used = message.wheel_speed_used;
  estimate.wheels.stamp = toNanoseconds(message.wheel_stamp);
  estimate.wheels.motion.forward_mps = message.wheel_speed_mps;
  estimate.motion.duration_s = message.duration_s;
  estimate.motion.v_eb_b = vectorOf(message.v_eb_b);
  return estimate;
}

ErrorCovariance covarianceOf(const ForecastInput& message) {
  return Eigen::Map<const RowMajorCovariance>(message.covariance.data());
}

void fill(const Correction& correction, FilterCorrection& message) {
  const auto& [sequence, epoch, state] = correction;
  message.corrects = true;
  message.sequence = sequence;
  message.epoch = epoch;
  message.state = toMessage(state);
}

Correction fromMessage(const FilterCorrection& message) {
  return {message.sequence, message.epoch, fromMessage(message.state)};
}

}  // namespace slipnav
