#include "analytic_motion.h"

#include <array>
#include <cmath>
#include <utility>

#include "slipnav/core/base/rotation.h"

namespace slipnav::test {
namespace {

struct QuadraturePoint {
  double place;  ///< in [−1, 1]
  double weight;
};

/// Abscissas and weights of 8-point Gauss–Legendre quadrature (Abramowitz and Stegun, table 25.4).
constexpr std::array<QuadraturePoint, 4> kHalfOfPoints = {{{0.183434642495650, 0.362683783378362},
                                                           {0.525532409916329, 0.313706645877887},
                                                           {0.796666477413627, 0.222381034453374},
                                                           {0.960289856497536, 0.101228536290376}}};

}  // namespace

double Wave::at(double t_s) const {
  return offset + rate * t_s + amplitude * std::sin(frequency_radps * t_s + phase_rad);
}

double Wave::first(double t_s) const {
  return rate + amplitude * frequency_radps * std::cos(frequency_radps * t_s + phase_rad);
}

double Wave::second(double t_s) const {
  return -amplitude * frequency_radps * frequency_radps * std::sin(frequency_radps * t_s + phase_rad);
}

AttitudeFunction eulerAttitude(const Wave& roll, const Wave& pitch, const Wave& yaw) {
  return [=](double t_s) {
    const double phi = roll.at(t_s);
    const double theta = pitch.at(t_s);
    AttitudeMotion result;
    result.q_b_to_n = Eigen::AngleAxisd(yaw.at(t_s), Vector3::UnitZ()) * Eigen::AngleAxisd(theta, Vector3::UnitY()) *
                      Eigen::AngleAxisd(phi, Vector3::UnitX());
    const double roll_rate = roll.first(t_s);
    const double pitch_rate = pitch.first(t_s);
    const double yaw_rate = yaw.first(t_s);
    // Groves (2.59): the Euler rates along the axes they turn about
    result.omega_nb_b << roll_rate - std::sin(theta) * yaw_rate,
        std::cos(phi) * pitch_rate + std::sin(phi) * std::cos(theta) * yaw_rate,
        -std::sin(phi) * pitch_rate + std::cos(phi) * std::cos(theta) * yaw_rate;
    return result;
  };
}

AttitudeFunction coningAttitude(double angle_rad, double frequency_radps) {
  return [=](double t_s) {
    const double turn = frequency_radps * t_s;
    AttitudeMotion result;
    result.q_b_to_n = Eigen::AngleAxisd(angle_rad, Vector3(std::cos(turn), std::sin(turn), 0.0));
    result.omega_nb_b = frequency_radps * Vector3(-std::sin(turn) * std::sin(angle_rad),
                                                  std::cos(turn) * std::sin(angle_rad), std::cos(angle_rad) - 1.0);
    return result;
  };
}

AnalyticMotion::AnalyticMotion(const Planet& planet, AttitudeFunction attitude, const Wave& latitude_rad,
                               const Wave& longitude_rad, const Wave& height_m)
    : planet_(planet),
      attitude_(std::move(attitude)),
      latitude_rad_(latitude_rad),
      longitude_rad_(longitude_rad),
      height_m_(height_m) {}

NavigationState AnalyticMotion::state(double t_s) const {
  NavigationState state;
  state.stamp = kEpoch + fromSeconds(t_s);
  state.q_b_to_n = attitude_(t_s).q_b_to_n;
  state.v_eb_n = velocity_n(t_s);
  state.position = {latitude_rad_.at(t_s), wrapToPi(longitude_rad_.at(t_s)), height_m_.at(t_s)};
  return state;
}

Vector3 AnalyticMotion::velocity_n(double t_s) const {
  const double latitude = latitude_rad_.at(t_s);
  const double height = height_m_.at(t_s);
  return {latitude_rad_.first(t_s) * (planet_.meridianRadius(latitude) + height),
          longitude_rad_.first(t_s) * (planet_.transverseRadius(latitude) + height) * std::cos(latitude),
          -height_m_.first(t_s)};
}

Vector3 AnalyticMotion::acceleration_n(double t_s) const {
  const double a = planet_.equatorialRadius();
  const double e2 = planet_.flattening() * (2.0 - planet_.flattening());
  const double latitude = latitude_rad_.at(t_s);
  const double sine = std::sin(latitude);
  const double cosine = std::cos(latitude);
  const double w = std::sqrt(1.0 - e2 * sine * sine);
  const double north_m = a * (1.0 - e2) / (w * w * w) + height_m_.at(t_s);
  const double east_m = a / w + height_m_.at(t_s);
  const double north_by_latitude = 3.0 * a * (1.0 - e2) * e2 * sine * cosine / std::pow(w, 5);
  const double east_by_latitude = a * e2 * sine * cosine / (w * w * w);
  const double dL = latitude_rad_.first(t_s);
  const double dlambda = longitude_rad_.first(t_s);
  const double dh = height_m_.first(t_s);
  return {latitude_rad_.second(t_s) * north_m + dL * (north_by_latitude * dL + dh),
          longitude_rad_.second(t_s) * east_m * cosine + dlambda * (east_by_latitude * dL + dh) * cosine -
              dlambda * dL * east_m * sine,
          -height_m_.second(t_s)};
}

Vector3 AnalyticMotion::omega_in_n(double t_s) const {
  const double latitude = latitude_rad_.at(t_s);
  const double dL = latitude_rad_.first(t_s);
  const double eastward = planet_.rotationRate() + longitude_rad_.first(t_s);
  return {eastward * std::cos(latitude), -dL, -eastward * std::sin(latitude)};
}

ImuInterval AnalyticMotion::imu(double from_s, double to_s) const {
  ImuInterval mean;
  mean.duration_s = to_s - from_s;
  for (const QuadraturePoint& point : kHalfOfPoints) {
    for (const double place : {-point.place, point.place}) {
      const double t_s = 0.5 * (from_s + to_s) + 0.5 * (to_s - from_s) * place;
      const AttitudeMotion attitude = attitude_(t_s);
      const Quaternion q_n_to_b = attitude.q_b_to_n.conjugate();
      const NavigationState truth = state(t_s);
      const Vector3 omega_in = omega_in_n(t_s);
      const Vector3 omega_ie = planet_.rotationRate() * Vector3(std::cos(truth.position.latitude_rad), 0.0,
                                                                -std::sin(truth.position.latitude_rad));
      // Groves (5.54), solved for the specific force
      const Vector3 f_n =
          acceleration_n(t_s) + (omega_in + omega_ie).cross(truth.v_eb_n) - planet_.gravity_n(truth.position);
      mean.f_ib_b += 0.5 * point.weight * (q_n_to_b * f_n);
      mean.omega_ib_b += 0.5 * point.weight * (attitude.omega_nb_b + q_n_to_b * omega_in);
    }
  }
  return mean;
}

NavigationState mechanize(const AnalyticMotion& motion, const std::vector<double>& ends_s, double start_s) {
  const Strapdown strapdown(motion.planet());
  NavigationState state = motion.state(0.0);
  ImuInterval previous = motion.imu(start_s, 0.0);
  double from_s = 0.0;
  for (const double to_s : ends_s) {
    const ImuInterval current = motion.imu(from_s, to_s);
    state = strapdown.propagate(state, previous, current, AnalyticMotion::kEpoch + fromSeconds(to_s));
    previous = current;
    from_s = to_s;
  }
  return state;
}

NavigationState mechanize(const AnalyticMotion& motion, double duration_s, double rate_hz) {
  std::vector<double> ends_s;
  const auto count = static_cast<int>(std::lround(duration_s * rate_hz));
  ends_s.reserve(static_cast<std::size_t>(count));
  for (int i = 1; i <= count; ++i) {
    ends_s.push_back(static_cast<double>(i) / rate_hz);
  }
  return mechanize(motion, ends_s, -1.0 / rate_hz);
}

}  // namespace slipnav::test
