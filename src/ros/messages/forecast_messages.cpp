#include "ros/messages/forecast_messages.h"

#include "ros/messages/conversions.h"

namespace slipnav {
namespace {

std::vector<double> toVector(const Eigen::VectorXd& values) { return {values.data(), values.data() + values.size()}; }

}  // namespace

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
