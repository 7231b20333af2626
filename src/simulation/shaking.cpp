#include "simulation/shaking.h"

#include <algorithm>
#include <cmath>

#include "simulation/ground.h"

namespace slipnav::sim {

Shaking::Shaking(const ShakingParams& params, bool samples_mean, std::uint64_t seed)
    : params_(params),
      active_(params.broad_mps2 > 0.0 || params.broad_deg_per_s > 0.0 || params.motor_mps2 > 0.0 ||
              params.motor_deg_per_s > 0.0 || params.engine_mps2 > 0.0 || params.engine_deg_per_s > 0.0),
      samples_mean_(samples_mean),
      stream_(seed, "shaking") {
  for (Phases* phases : {&motor_phases_, &engine_phases_}) {
    for (double& phase : *phases) {
      phase = stream_.uniform(0.0, 2.0 * kPi);
    }
  }
}

/// Harmonics fall off as 1/n; every axis has its own phases.
InertialMean Shaking::lines(double turns, const Phases& phases, double accel_mps2, double gyro_radps) const {
  InertialMean sum;
  for (std::size_t n = 1; n <= kHarmonics; ++n) {
    for (std::size_t axis = 0; axis < 6; ++axis) {
      const double line =
          std::sin(2.0 * kPi * static_cast<double>(n) * turns + phases[6 * (n - 1) + axis]) / static_cast<double>(n);
      const auto component = static_cast<Eigen::Index>(axis % 3);
      (axis < 3 ? sum.f_ib_b : sum.omega_ib_b)[component] += (axis < 3 ? accel_mps2 : gyro_radps) * line;
    }
  }
  return sum;
}

void Shaking::advance(double travel_m, double dt_s) {
  if (!active_) {
    return;
  }
  time_s_ += dt_s;
  InertialMean now;
  if (travel_m != last_travel_m_) {
    now = lines(params_.motor_turns_per_m * travel_m, motor_phases_, params_.motor_mps2,
                degToRad(params_.motor_deg_per_s));
  }
  if (params_.engine_mps2 > 0.0 || params_.engine_deg_per_s > 0.0) {
    const InertialMean engine =
        lines(params_.engine_hz * time_s_, engine_phases_, params_.engine_mps2, degToRad(params_.engine_deg_per_s));
    now.f_ib_b += engine.f_ib_b;
    now.omega_ib_b += engine.omega_ib_b;
  }
  last_travel_m_ = travel_m;
  if (!samples_mean_) {
    sum_ = {};
    steps_ = 0;
  }
  sum_.f_ib_b += now.f_ib_b;
  sum_.omega_ib_b += now.omega_ib_b;
  ++steps_;
}

InertialMean Shaking::sample(double speed_mps) {
  if (!active_) {
    return {};
  }
  const double part = std::min(1.0, speed_mps / kVibrationSpeed_mps);
  InertialMean sample{sum_.f_ib_b / std::max(steps_, 1), sum_.omega_ib_b / std::max(steps_, 1)};
  sample.f_ib_b += part * params_.broad_mps2 * stream_.normal3();
  sample.omega_ib_b += part * degToRad(params_.broad_deg_per_s) * stream_.normal3();
  sum_ = {};
  steps_ = 0;
  return sample;
}

}  // namespace slipnav::sim
