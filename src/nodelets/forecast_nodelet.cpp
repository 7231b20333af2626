/// slipnav/Forecast: learns the slip of the last seconds, and forecasts slip and position error.
///
/// In: forecast_input. Out: slip_forecast, error_forecast, forecast_progress.

#include <slipnav/ErrorForecast.h>
#include <slipnav/ForecastInput.h>
#include <slipnav/SlipForecast.h>
#include <std_msgs/Header.h>
#include <pluginlib/class_list_macros.hpp>

#include <boost/make_shared.hpp>
#include <memory>
#include <optional>
#include <string>

#include "core/forecast/forecast_method.h"
#include "ros/messages/conversions.h"
#include "ros/messages/forecast_messages.h"
#include "ros/runtime/internal_topics.h"
#include "ros/runtime/nodelet_base.h"

namespace slipnav {

namespace {

/// [s] by stamps that a problem must last before it is a warning: filling windows and failing fits are normal.
constexpr double kTrouble_s = 5.0;
/// [s] without an estimate.
constexpr double kSilence_s = 2.0;

}  // namespace

class ForecastNodelet : public NodeletBase {
 public:
  ~ForecastNodelet() override { stop(); }

 private:
  void begin(const Config& config) override {
    frames_ = config.frames;
    model_ = config.forecast.slip.model;
    forecaster_ = makeForecastMethod(Planet::byName(config.planet), config.navigation().filter, config.forecast);
  }

  void subscribe(const Config&) override {
    listen<ForecastInput>(kForecastInputTopic, &ForecastNodelet::onInput);
    offerTuning("Forecast");
  }

  void retune(const Config& config) override { forecaster_->retune(config.navigation().filter, config.forecast); }

  void advertise(const Config& config) override {
    slip_publisher_ = publisher<SlipForecast>(config.topics.slip_forecast);
    error_publisher_ = publisher<ErrorForecast>(config.topics.error_forecast);
    progress_publisher_ = publisher<std_msgs::Header>(kForecastProgressTopic);
  }

  void onInput(const ForecastInput::ConstPtr& message) {
    const double begin_s = now();
    const Estimate estimate = estimateOf(*message);
    newest_ = estimate.nav.stamp;
    inputs_watch_.heard(clocks());
    if (const std::optional<Forecast> forecast = forecaster_->push(estimate, covarianceOf(*message))) {
      computation_ms_ = 1e3 * (now() - begin_s);
      publish(*forecast);
    } else if (!forecaster_->problem().empty()) {
      NODELET_WARN_THROTTLE(5.0, "no forecast at %.1f s: %s", toSeconds(newest_), forecaster_->problem().c_str());
    }
    if (troubleOf().empty() || newest_ < fine_until_) {
      fine_until_ = newest_;
    }
    const auto progress = boost::make_shared<std_msgs::Header>();
    progress->stamp = message->state.stamp;
    progress_publisher_.publish(progress);
  }

  void publish(const Forecast& forecast) {
    ++forecasts_;
    last_ = forecast.error.stamp;
    fit_ = forecast.fit;
    time_to_stop_s_ = forecast.error.time_to_stop_s;
    const auto slip = boost::make_shared<SlipForecast>();
    fill(forecast, model_, computation_ms_, frames_, *slip);
    slip_publisher_.publish(slip);
    const auto error = boost::make_shared<ErrorForecast>();
    fill(forecast.error, frames_, *error);
    error_publisher_.publish(error);
  }

  /// Problem of the newest forecast, otherwise "". Single ones are normal.
  std::string troubleOf() const {
    if (!forecaster_->problem().empty()) {
      return "no forecast: " + forecaster_->problem();
    }
    const bool fitted =
        forecasts_ == 0 || fit_.status == SlipFitStatus::kConverged || fit_.status == SlipFitStatus::kTooFewSamples;
    return fitted ? "" : std::string("the fit did not converge: ") + toString(fit_.status);
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    using diagnostic_msgs::DiagnosticStatus;
    const double age_s = toSeconds(newest_ - last_);
    const std::string trouble = newest_ == 0 ? "" : troubleOf();
    const bool lasts = !trouble.empty() && toSeconds(newest_ - fine_until_) > kTrouble_s;
    if (inputs_watch_.isSilent(clocks())) {
      status.summary(DiagnosticStatus::STALE, "estimates have stopped");
    } else if (newest_ == 0) {
      status.summary(DiagnosticStatus::OK, "waiting for estimates");
    } else if (lasts) {
      status.summary(DiagnosticStatus::WARN, trouble);
    } else {
      status.summary(DiagnosticStatus::OK,
                     fit_.status == SlipFitStatus::kTooFewSamples ? "collecting slip" : "forecasting");
    }
    status.add("forecasts", forecasts_);
    status.addf("age of the forecast [s]", "%.1f", forecasts_ > 0 ? age_s : 0.0);
    status.addf("computation [ms]", "%.1f", computation_ms_);
    status.addf("time to stop [s]", "%.1f", time_to_stop_s_);
    status.add("slip samples", fit_.samples);
    status.add("slip samples dropped", fit_.left_out);
    status.addf("log marginal likelihood", "%.2f", fit_.log_marginal_likelihood);
    for (const auto& [name, value] : fit_.hyperparameters) {
      status.addf(name, "%.4g", value);
    }
  }

  FrameNames frames_;
  std::string model_;
  std::unique_ptr<ForecastMethod> forecaster_;
  SlipFit fit_;
  double time_to_stop_s_ = 0.0;
  double computation_ms_ = 0.0;
  std::uint64_t forecasts_ = 0;
  Nanoseconds newest_ = 0;  ///< estimate
  Nanoseconds last_ = 0;    ///< forecast
  Nanoseconds fine_until_ = 0;
  SilenceWatch inputs_watch_{kSilence_s};
  SharedPublisher<SlipForecast> slip_publisher_;
  SharedPublisher<ErrorForecast> error_publisher_;
  SharedPublisher<std_msgs::Header> progress_publisher_;
};

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::ForecastNodelet, nodelet::Nodelet)
