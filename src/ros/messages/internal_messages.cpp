#include "ros/messages/internal_messages.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "ros/messages/conversions.h"

namespace slipnav {

// Structs are taken apart member by member, so that one that gains a member does not compile until it is sent too.

namespace {

static_assert(StartState::_covariance_type::static_size == kErrorStates * kErrorStates);

}  // namespace

InertialState toMessage(const NavigationState& state) {
  const auto& [stamp, q_b_to_n, v_eb_n, position, accel_bias_b, gyro_bias_b, imu_offset_b] = state;
  InertialState message;
  message.stamp = toRosTime(stamp);
  message.q_b_to_n = {q_b_to_n.w(), q_b_to_n.x(), q_b_to_n.y(), q_b_to_n.z()};
  copyVector(v_eb_n, message.v_eb_n);
  message.latitude_rad = position.latitude_rad;
  message.longitude_rad = position.longitude_rad;
  message.height_m = position.height_m;
  copyVector(accel_bias_b, message.accel_bias_b);
  copyVector(gyro_bias_b, message.gyro_bias_b);
  copyVector(imu_offset_b, message.imu_offset_b);
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
  state.imu_offset_b = vectorOf(message.imu_offset_b);
  return state;
}

InsInterval toMessage(const InsStep& step) {
  const auto& [epoch, start, state, f_ib_b, omega_ib_b, gap_s] = step;
  static_cast<void>(epoch);  // of the whole batch
  InsInterval message;
  message.start = toRosTime(start);
  message.state = toMessage(state);
  copyVector(f_ib_b, message.f_ib_b);
  copyVector(omega_ib_b, message.omega_ib_b);
  message.gap_s = gap_s;
  return message;
}

InsStep fromMessage(const InsInterval& message, std::uint32_t epoch) {
  InsStep step;
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

void fill(const Start& start, StartState& message) {
  message.start = start.number;
  message.session = start.session;
  message.known = start.state.has_value();
  if (!message.known) {
    return;
  }
  const auto& [nav, vehicle, P, origin, standstill_variance] = *start.state;
  const auto& [wheel_scale, slow_slip, fast_slip, side_slip, mount_pitch_rad, mount_yaw_rad] = vehicle;
  message.state = toMessage(nav);
  message.vehicle = {wheel_scale, slow_slip, fast_slip, side_slip, mount_pitch_rad, mount_yaw_rad};
  Eigen::Map<RowMajorCovariance>(message.covariance.data()) = P;
  message.standstill_variance = standstill_variance;
  message.origin_latitude_rad = origin.latitude_rad;
  message.origin_longitude_rad = origin.longitude_rad;
  message.origin_height_m = origin.height_m;
}

Start fromMessage(const StartState& message) {
  Start start{message.start, message.session, std::nullopt};
  if (!message.known) {
    return start;
  }
  InitialState& initial = start.state.emplace();
  initial.nav = fromMessage(message.state);
  initial.vehicle = {message.vehicle[0], message.vehicle[1], message.vehicle[2],
                     message.vehicle[3], message.vehicle[4], message.vehicle[5]};
  initial.P = Eigen::Map<const RowMajorCovariance>(message.covariance.data());
  initial.standstill_variance = message.standstill_variance;
  initial.origin = {message.origin_latitude_rad, message.origin_longitude_rad, message.origin_height_m};
  return start;
}

void fill(const Reply& reply, FilterCorrection& message) {
  message.start = reply.start;
  message.corrects = reply.correction.has_value();
  if (reply.correction) {
    const auto& [epoch, state] = *reply.correction;
    message.epoch = epoch;
    message.state = toMessage(state);
  }
  message.run_until = toRosTime(reply.run_until);
}

Reply fromMessage(const FilterCorrection& message) {
  Reply reply{message.start, std::nullopt, toNanoseconds(message.run_until)};
  if (message.corrects) {
    reply.correction = Correction{message.epoch, fromMessage(message.state)};
  }
  return reply;
}

}  // namespace slipnav
