/// Navigation without ROS: samples of an IMU and of wheels go in, estimates with their covariance come out.
///
/// The samples here are made up: ten seconds of rest, then half a minute straight to the north-east at 0.5 m/s, on
/// wheels whose radius is given 1 % too large.

#include <slipnav/core/base/rotation.h>
#include <slipnav/core/earth/local_frame.h>
#include <slipnav/core/navigation/pipeline.h>

#include <cmath>
#include <cstdio>

namespace {

constexpr double kImuInterval_s = 0.02;
constexpr int kImuPerWheels = 5;
constexpr double kRest_s = 10.0;
constexpr double kSpeedUp_s = 2.0;
constexpr double kDrive_s = 40.0;
constexpr double kSpeed_mps = 0.5;
constexpr double kHeading_deg = 45.0;
constexpr double kRadiusError = 0.01;
constexpr double kDegree = M_PI / 180.0;

double speedAt(double t_s) { return kSpeed_mps * std::fmin(std::fmax((t_s - kRest_s) / kSpeedUp_s, 0.0), 1.0); }

/// What a perfect IMU measures in the interval that ends at `t_s`: its own acceleration less gravity, and the turn of
/// the planet. Body axes are forward, right, down.
slipnav::ImuSample imuAt(double t_s, const slipnav::Planet& planet, const slipnav::Geodetic& position) {
  const slipnav::Quaternion q_b_to_n = slipnav::q_b_to_n_fromEuler(0.0, 0.0, kHeading_deg * kDegree);
  const double acceleration_mps2 = (speedAt(t_s) - speedAt(t_s - kImuInterval_s)) / kImuInterval_s;
  slipnav::ImuSample sample;
  sample.stamp = slipnav::fromSeconds(t_s);
  sample.f_ib_b = slipnav::Vector3(acceleration_mps2, 0.0, 0.0) - q_b_to_n.conjugate() * planet.gravity_n(position);
  sample.omega_ib_b = q_b_to_n.conjugate() * planet.omega_ie_n(position.latitude_rad);
  return sample;
}

/// Forward speed of the wheels, mean over the interval that ends at `t_s`.
slipnav::WheelMotion wheelsAt(double t_s) {
  const double middle_s = t_s - 0.5 * kImuPerWheels * kImuInterval_s;
  return slipnav::toWheelMotion(
      slipnav::SpeedSample{slipnav::fromSeconds(t_s), (1.0 + kRadiusError) * speedAt(middle_s)});
}

}  // namespace

int main() {
  const slipnav::Planet planet = slipnav::Planet::byName("earth");
  slipnav::NavigationSetup setup;
  setup.initialization.source = "given";
  setup.initialization.heading_deg = kHeading_deg;
  const slipnav::Geodetic origin = {setup.initialization.latitude_deg * kDegree,
                                    setup.initialization.longitude_deg * kDegree, setup.initialization.height_m};
  const slipnav::LocalFrame map(planet, origin);

  slipnav::Estimate newest;
  slipnav::ErrorCovariance covariance;
  slipnav::Pipeline pipeline(planet, setup, [&](const slipnav::Estimate& estimate, const slipnav::ErrorCovariance& P) {
    newest = estimate;
    covariance = P;
  });
  for (int i = 1; i * kImuInterval_s <= kDrive_s; ++i) {
    const double t_s = i * kImuInterval_s;
    pipeline.push(imuAt(t_s, planet, origin));
    if (i % kImuPerWheels == 0) {
      pipeline.push(wheelsAt(t_s));
    }
  }

  const slipnav::Vector3 position_enu_m = map.toEnu(newest.nav.position);
  const double way_m = kSpeed_mps * (kDrive_s - kRest_s - 0.5 * kSpeedUp_s);
  std::printf("driven %.2f m; east %.2f m, north %.2f m, 1 sigma %.2f and %.2f m; last known at %.2f s\n", way_m,
              position_enu_m.x(), position_enu_m.y(),
              std::sqrt(covariance(slipnav::kPosition + 1, slipnav::kPosition + 1)),
              std::sqrt(covariance(slipnav::kPosition, slipnav::kPosition)), slipnav::toSeconds(newest.nav.stamp));
  return 0;
}
