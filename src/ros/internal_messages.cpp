#include "slipnav/ros/internal_messages.h"

#include <algorithm>

#include "slipnav/ros/conversions.h"

namespace slipnav {
namespace {

template <class Array>
void copyVector(const Vector3& v, Array& array) {
  std::copy(v.data(), v.data() + 3, array.begin());
}

template <class Array>
Vector3 vectorOf(const Array& array) {
  return {array[0], array[1], array[2]};
}

using RowMajorCovariance = Eigen::Matrix<double, kErrorStates, kErrorStates, Eigen::RowMajor>;

}  // namespace

InertialState toMessage(const NavigationState& state) {
  InertialState message;
  message.stamp = toRosTime(state.stamp);
  message.q_b_to_n = {state.q_b_to_n.w(), state.q_b_to_n.x(), state.q_b_to_n.y(), state.q_b_to_n.z()};
  copyVector(state.v_eb_n, message.v_eb_n);
  message.latitude_rad = state.position.latitude_rad;
  message.longitude_rad = state.position.longitude_rad;
  message.height_m = state.position.height_m;
  copyVector(state.accel_bias_b, message.accel_bias_b);
  copyVector(state.gyro_bias_b, message.gyro_bias_b);
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
  InsInterval message;
  message.sequence = step.sequence;
  message.start = toRosTime(step.start);
  message.state = toMessage(step.state);
  copyVector(step.f_ib_b, message.f_ib_b);
  copyVector(step.omega_ib_b, message.omega_ib_b);
  message.gap_s = step.gap_s;
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

void fill(const InitialState& initial, StartState& message) {
  message.state = toMessage(initial.nav);
  const VehicleState& vehicle = initial.vehicle;
  message.vehicle = {vehicle.wheel_scale, vehicle.slow_slip,       vehicle.fast_slip,
                     vehicle.side_slip,   vehicle.mount_pitch_rad, vehicle.mount_yaw_rad};
  Eigen::Map<RowMajorCovariance>(message.covariance.data()) = initial.P;
  message.origin_latitude_rad = initial.origin.latitude_rad;
  message.origin_longitude_rad = initial.origin.longitude_rad;
  message.origin_height_m = initial.origin.height_m;
}

InitialState fromMessage(const StartState& message) {
  InitialState initial;
  initial.nav = fromMessage(message.state);
  initial.vehicle = {message.vehicle[0], message.vehicle[1], message.vehicle[2],
                     message.vehicle[3], message.vehicle[4], message.vehicle[5]};
  initial.P = Eigen::Map<const RowMajorCovariance>(message.covariance.data());
  initial.origin = {message.origin_latitude_rad, message.origin_longitude_rad, message.origin_height_m};
  return initial;
}

Correction fromMessage(const FilterCorrection& message) {
  return {message.sequence, message.epoch, fromMessage(message.state)};
}

}  // namespace slipnav
