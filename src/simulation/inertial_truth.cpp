#include "simulation/inertial_truth.h"

namespace slipnav::sim {

InertialTruth::InertialTruth(const Planet& planet, const LocalFrame& frame, const Vector3& lever_b,
                             const Kinematics& start)
    : planet_(planet),
      frame_(frame),
      lever_b_(lever_b),
      omega_ie_enu_(frame.C_n_to_enu(frame.origin()) * planet.omega_ie_n(frame.origin().latitude_rad)),
      last_(start),
      last_gravity_enu_(gravityAt(start)) {}

Vector3 InertialTruth::sensorVelocity(const Kinematics& state) const {
  return state.v_eb_enu + state.C_b_to_enu * state.omega_eb_b.cross(lever_b_);
}

Vector3 InertialTruth::gravityAt(const Kinematics& state) const {
  const Geodetic position = frame_.toGeodetic(state.position_enu_m + state.C_b_to_enu * lever_b_);
  return frame_.C_n_to_enu(position) * planet_.gravity_n(position);
}

void InertialTruth::add(const Kinematics& state, double dt_s) {
  const Vector3 v_last = sensorVelocity(last_);
  const Vector3 v = sensorVelocity(state);
  const Matrix3 C_mean = 0.5 * (last_.C_b_to_enu + state.C_b_to_enu);
  const Vector3 acceleration_step_b = C_mean.transpose() * (v - v_last + dt_s * omega_ie_enu_.cross(v_last + v));
  acceleration_sum_b_ += acceleration_step_b;
  instant_ = {acceleration_step_b / dt_s - C_mean.transpose() * last_gravity_enu_,
              state.omega_eb_b + state.C_b_to_enu.transpose() * omega_ie_enu_};
  rate_sum_b_ += dt_s * (0.5 * (last_.omega_eb_b + state.omega_eb_b) + C_mean.transpose() * omega_ie_enu_);
  rotation_sum_ += dt_s * C_mean;
  time_s_ += dt_s;
  angular_acceleration_b_ = (state.omega_eb_b - last_.omega_eb_b) / dt_s;
  last_dt_s_ = dt_s;
  last_ = state;
}

InertialMean InertialTruth::finish() {
  const Vector3 gravity_enu = gravityAt(last_);
  const Vector3 gravity_b = rotation_sum_.transpose() * (0.5 * (last_gravity_enu_ + gravity_enu));
  // what the trapezoid rule neglects (Euler and Maclaurin): tiny, but it does not commute and would accumulate in
  // attitude
  rate_sum_b_ += last_dt_s_ * last_dt_s_ / 12.0 * (start_angular_acceleration_b_ - angular_acceleration_b_);
  start_angular_acceleration_b_ = angular_acceleration_b_;
  const InertialMean mean{(acceleration_sum_b_ - gravity_b) / time_s_, rate_sum_b_ / time_s_};
  last_gravity_enu_ = gravity_enu;
  acceleration_sum_b_.setZero();
  rate_sum_b_.setZero();
  rotation_sum_.setZero();
  time_s_ = 0.0;
  return mean;
}

}  // namespace slipnav::sim
