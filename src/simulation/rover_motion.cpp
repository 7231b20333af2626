#include "simulation/rover_motion.h"

#include <algorithm>
#include <cmath>

namespace slipnav::sim {
namespace {

/// How long the ground takes to give way, and to hold again.
constexpr double kGripChange_s = 0.5;

bool isLeft(std::size_t wheel) { return wheel % 2 == 0; }

PerWheel drawRadii(const VehicleParams& vehicle, std::uint64_t seed) {
  RandomStream stream(seed, "wheel radii");
  const double common = vehicle.common_radius_error * stream.normal();
  PerWheel radii;
  for (double& radius : radii) {
    radius = vehicle.wheel_radius_m * (1.0 + common + vehicle.wheel_radius_error * stream.normal());
  }
  return radii;
}

}  // namespace

double slipRatio(double ground_speed_mps, double surface_speed_mps) {
  if (ground_speed_mps == 0.0 && surface_speed_mps == 0.0) {
    return 0.0;
  }
  const bool driving = std::abs(ground_speed_mps) <= std::abs(surface_speed_mps);
  const double slip = driving ? 1.0 - ground_speed_mps / surface_speed_mps : surface_speed_mps / ground_speed_mps - 1.0;
  return std::clamp(slip, -1.0, 1.0);
}

RoverMotion::RoverMotion(const VehicleParams& vehicle, const GroundParams& ground, double start_heading_rad,
                         double straight_m, std::uint64_t seed, const BodyParams& body, const StuckPlace& stuck)
    : vehicle_(vehicle),
      terrain_(Terrain(ground.relief, start_heading_rad, straight_m, seed)),
      slip_model_(ground.slip, seed),
      radius_m_(drawRadii(vehicle, seed)),
      forward_(vehicle.acceleration_mps2),
      difference_(vehicle.acceleration_mps2),
      body_(body, seed),
      stuck_(stuck) {
  value_[kHeading] = start_heading_rad;
  if (body_.rocks()) {
    value_.segment<kBodyAxes>(kBody) = body_.stones(0.0);
  }
  evaluate();
}

void RoverMotion::advance(double forward_mps, double yaw_rate_radps, double dt_s) {
  integrate(dt_s);
  forward_.advance(forward_mps, dt_s);
  difference_.advance(0.5 * yaw_rate_radps * vehicle_.assumed_track_factor * vehicle_.track_m, dt_s);
  const bool at_rest = forward_.atRest() && difference_.atRest() && bodyHolds();
  if (stuck_.duration_s > 0.0 && value_[kDistance] >= stuck_.distance_m) {
    stuck_time_s_ += dt_s;
  }
  if (at_rest && state_.standstill) {
    return;
  }
  if (at_rest) {
    value_.segment<kBodyAxes>(kBodyRate).setZero();
  }
  evaluate();
  state_.standstill = at_rest;
}

bool RoverMotion::bodyHolds() {
  return !body_.isSprung() || body_.holds(body_.stones(value_[kDistance]) - value_.segment<kBodyAxes>(kBody),
                                          value_.segment<kBodyAxes>(kBodyRate));
}

/// Fraction of the wheel surface speed that the ground takes: 1, and 0 where the rover is stuck.
double RoverMotion::grip() const {
  if (stuck_time_s_ <= 0.0 || stuck_time_s_ >= stuck_.duration_s) {
    return 1.0;
  }
  const double edge_s = std::min(stuck_time_s_, stuck_.duration_s - stuck_time_s_);
  return 0.5 + 0.5 * std::cos(kPi * std::min(1.0, edge_s / kGripChange_s));
}

/// Third-order Adams-Bashforth by divided differences, for steps of varying length.
void RoverMotion::integrate(double dt_s) {
  if (state_.standstill) {
    history_ = {Integrals::Zero(), Integrals::Zero(), dt_s, dt_s};
    return;
  }
  const Integrals slope = (rate_ - history_.rate) / history_.dt_s;
  const Integrals curvature = (slope - history_.slope) / (history_.dt_s + history_.earlier_dt_s);
  value_ += dt_s * (rate_ + 0.5 * dt_s * slope + dt_s * (dt_s / 3.0 + 0.5 * history_.dt_s) * curvature);
  history_ = {rate_, slope, dt_s, history_.dt_s};
}

void RoverMotion::evaluate() {
  const SurfacePoint surface = terrain_.at(value_.segment<2>(kEast));
  state_.position_enu_m << value_[kEast], value_[kNorth], surface.height_m;
  state_.distance_m = value_[kDistance];
  setAttitude(surface);

  const double direction = forward_.speed() < 0.0 ? -1.0 : 1.0;
  const Slippage slippage = slip_model_.at(
      {value_[kTravel], direction * state_.C_b_to_enu(2, 0), -state_.C_b_to_enu(2, 1), surface.looseness});
  moveBody(surface, slippage);
  turnWheels(slippage, state_.omega_eb_b.z());
  if (body_.rocks()) {
    rockBody();
  }
}

/// Down is the surface's inward normal; forward is the tangent whose horizontal projection has the heading.
void RoverMotion::setAttitude(const SurfacePoint& surface) {
  const Vector2 ahead(std::sin(value_[kHeading]), std::cos(value_[kHeading]));
  const Vector3 down = Vector3(surface.gradient.x(), surface.gradient.y(), -1.0).normalized();
  const Vector3 forward = Vector3(ahead.x(), ahead.y(), surface.gradient.dot(ahead)).normalized();
  state_.C_b_to_enu << forward, down.cross(forward), down;
}

void RoverMotion::moveBody(const SurfacePoint& surface, const Slippage& slippage) {
  const double radius_left = 0.5 * (radius_m_[0] + radius_m_[2]) / vehicle_.wheel_radius_m;
  const double radius_right = 0.5 * (radius_m_[1] + radius_m_[3]) / vehicle_.wheel_radius_m;
  const double held = grip();
  const double left_mps = held * radius_left * (forward_.speed() + difference_.speed()) * (1.0 - slippage.left);
  const double right_mps = held * radius_right * (forward_.speed() - difference_.speed()) * (1.0 - slippage.right);
  const double forward_mps = 0.5 * (left_mps + right_mps);
  const double yaw_rate_radps = (left_mps - right_mps) / (slippage.track_factor * vehicle_.track_m);
  state_.v_eb_b << forward_mps, std::abs(forward_mps) * slippage.lateral - slippage.turning_point_m * yaw_rate_radps,
      0.0;
  state_.v_eb_enu = state_.C_b_to_enu * state_.v_eb_b;

  // the axes rotate with the surface normal along the path; see doc/simulator.md
  const Vector3 forward = state_.C_b_to_enu.col(0);
  const Vector3 right = state_.C_b_to_enu.col(1);
  const Vector2 gradient_rate = surface.hessian_per_m * state_.v_eb_enu.head<2>();
  const double normal_length = std::sqrt(1.0 + surface.gradient.squaredNorm());
  state_.omega_eb_b << -gradient_rate.dot(right.head<2>()) / normal_length,
      gradient_rate.dot(forward.head<2>()) / normal_length, yaw_rate_radps;

  const Vector2 ahead(std::sin(value_[kHeading]), std::cos(value_[kHeading]));
  const Vector2 abeam(ahead.y(), -ahead.x());
  const double forward_length = std::sqrt(1.0 + std::pow(surface.gradient.dot(ahead), 2));
  rate_[kHeading] = (yaw_rate_radps * forward_length - gradient_rate.dot(ahead) * right.z()) /
                    (abeam.dot(right.head<2>()) + surface.gradient.dot(abeam) * right.z());
  rate_.segment<2>(kEast) = state_.v_eb_enu.head<2>();
  rate_[kTravel] = std::abs(forward_.speed());
  rate_[kDistance] = state_.v_eb_enu.norm();
  addHeave(slippage);
}

/// Stones under single wheels lift the body off the smooth relief and let it down again.
void RoverMotion::addHeave(const Slippage& slippage) {
  state_.position_enu_m.z() += slippage.heave_m;
  state_.v_eb_enu.z() += slippage.heave_slope * rate_[kTravel];
  state_.v_eb_b = state_.C_b_to_enu.transpose() * state_.v_eb_enu;
  state_.slip_angle_rad = state_.v_eb_b.isZero(0.0) ? 0.0 : std::atan2(state_.v_eb_b.y(), state_.v_eb_b.x());
}

void RoverMotion::turnWheels(const Slippage& slippage, double yaw_rate_radps) {
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const double side = isLeft(i) ? 1.0 : -1.0;
    const double commanded_mps = forward_.speed() + side * difference_.speed();
    state_.wheel_rate_radps[i] = commanded_mps * (1.0 + slippage.spin_up[i]) / vehicle_.wheel_radius_m;
    const double ground_mps = state_.v_eb_b.x() + side * 0.5 * vehicle_.track_m * yaw_rate_radps;
    state_.slip[i] = slipRatio(ground_mps, radius_m_[i] * state_.wheel_rate_radps[i]);
    const auto index = static_cast<Eigen::Index>(kWheelAngle + i);
    rate_[index] = state_.wheel_rate_radps[i];
    state_.wheel_angle_rad[i] = value_[index];
  }
}

/// Places the body over the path: pitch, then roll, about base_link, which is moved up and to the side.
void RoverMotion::rockBody() {
  const BodyVector stones = body_.stones(value_[kDistance]);
  const BodyVector stone_rate = body_.stoneSlopes(value_[kDistance]) * rate_[kDistance];
  BodyVector place = stones;
  BodyVector rate = stone_rate;
  if (body_.isSprung()) {
    place = value_.segment<kBodyAxes>(kBody);
    rate = value_.segment<kBodyAxes>(kBodyRate);
    rate_.segment<kBodyAxes>(kBody) = rate;
    rate_.segment<kBodyAxes>(kBodyRate) = body_.acceleration(stones - place, stone_rate - rate);
  }
  const Matrix3 C_path_to_enu = state_.C_b_to_enu;
  const Vector3 offset(0.0, place[kSway], 0.0);
  const Vector3 offset_rate(0.0, rate[kSway], 0.0);
  state_.position_enu_m += C_path_to_enu * offset + Vector3(0.0, 0.0, place[kHeave]);
  state_.v_eb_enu += C_path_to_enu * (offset_rate + state_.omega_eb_b.cross(offset)) + Vector3(0.0, 0.0, rate[kHeave]);
  const Matrix3 C_b_to_path =
      (Eigen::AngleAxisd(place[kPitch], Vector3::UnitY()) * Eigen::AngleAxisd(place[kRoll], Vector3::UnitX()))
          .toRotationMatrix();
  const Vector3 relative_b(rate[kRoll], rate[kPitch] * std::cos(place[kRoll]), -rate[kPitch] * std::sin(place[kRoll]));
  state_.C_b_to_enu = C_path_to_enu * C_b_to_path;
  state_.omega_eb_b = C_b_to_path.transpose() * state_.omega_eb_b + relative_b;
  state_.v_eb_b = state_.C_b_to_enu.transpose() * state_.v_eb_enu;
}

}  // namespace slipnav::sim
