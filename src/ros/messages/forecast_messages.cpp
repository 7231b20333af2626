#include "ros/messages/forecast_messages.h"

#include <algorithm>
#include <array>

#include "ros/messages/conversions.h"
#include "ros/messages/internal_messages.h"

namespace slipnav {
namespace {

std::vector<double> toVector(const Eigen::VectorXd& values) { return {values.data(), values.data() + values.size()}; }

}  // namespace

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

void fill(const Forecast& forecast, const std::string& model, double computation_ms, const FrameNames& frames,
          SlipForecast& message) {
  message.header.stamp = toRosTime(forecast.error.stamp);
  message.header.frame_id = frames.base;
  message.model = model;
  message.times_s = toVector(forecast.slip.times_s);
  message.mean = toVector(forecast.slip.mean);
  message.stddev = toVector(forecast.slip.stddev);
  message.variance = forecast.fit.hyperparameter("variance");
  message.length_scale_s = forecast.fit.hyperparameter("length_scale_s");
  message.noise_variance = forecast.fit.hyperparameter("noise_variance");
  message.log_marginal_likelihood = forecast.fit.log_marginal_likelihood;
  message.window_samples = static_cast<std::uint32_t>(forecast.fit.samples);
  message.computation_ms = computation_ms;
}

void fill(const ErrorOutlook& error, const FrameNames& frames, ErrorForecast& message) {
  message.header.stamp = toRosTime(error.stamp);
  message.header.frame_id = frames.map;
  message.times_s = error.times_s;
  message.horizontal_bound_m = error.horizontal_bound_m;
  message.threshold_m = error.threshold_m;
  message.time_to_stop_s = error.time_to_stop_s;
  message.stop_distance_m = error.stop_distance_m;
  message.kept_s = error.kept_s;
}

}  // namespace slipnav
