/// Forecasts of drives with stops, slip of all kinds, broken estimates and clocks that go back: no change of a bound, a
/// fit or a prediction goes without being noticed.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/forecast/gaussian_process_slip_model.h"
#include "core/forecast/paper_forecaster.h"
#include "core/forecast/slip_correlation.h"
#include "forecaster_fixture.h"
#include "reference_trace.h"

namespace slipnav::test {
namespace {

/// A drive over changing ground, estimated by a filter that the die makes doubt now and then.
class ChangingDrive {
 public:
  ChangingDrive(ForecastMethod& method, ForecastParams params, std::uint64_t seed)
      : dice_(seed), method_(method), params_(std::move(params)) {
    P_.diagonal().segment<3>(kAttitude).setConstant(1e-6);
    P_.diagonal().segment<3>(kVelocity).setConstant(1e-5);
    P_.diagonal().segment<3>(kPosition).setConstant(4.0);
    P_.diagonal().segment<3>(kAccelBias).setConstant(1e-8);
    P_.diagonal().segment<3>(kGyroBias).setConstant(1e-13);
    P_.diagonal().tail<kErrorStates - kNavStates>().setConstant(1e-5);
  }

  /// Some seconds of the same ground.
  void addLines(ReferenceTrace& trace) {
    stationary_ = dice_.oneIn(6);
    speed_mps_ = dice_.from<double>({0.8, 0.8, 0.3, 0.04, -0.6, 0.0});
    slip_ = dice_.from<double>({0.0, 0.05, 0.2, -0.1, 0.6});
    variation_ = dice_.from<double>({0.0, 0.01, 0.05});
    used_ = dice_.from<int>({1, 1, 3});
    factors_.slow_slip = dice_.from<double>({1.0, 4.0});
    factors_.fast_slip = dice_.from<double>({1.0, 2.0});
    P_(kSlowSlip, kSlowSlip) = dice_.from<double>({1e-5, 1e-5, 0.01});
    P_(kVelocity, kVelocity) = dice_.from<double>({1e-5, 1e-5, 0.01});
    now_ += dice_.from<Nanoseconds>({0, 0, 0, 2, 70}) * kSecond;
    if (dice_.oneIn(20)) {
      now_ -= 500 * kSecond;
    } else if (dice_.oneIn(20)) {
      method_.reset();
    } else if (dice_.oneIn(8)) {
      params_.threshold_m = dice_.from<double>({0.5, 3.0});
      method_.retune(Config().navigation().filter, params_);
    }
    for (int i = 0; i < 60; ++i) {
      const Estimate e = estimate();
      if (const std::optional<Forecast> forecast = method_.push(e, P_)) {
        note(*forecast, trace);
      }
    }
    trace.note(stationary_, speed_mps_, method_.problem());
  }

 private:
  Estimate estimate() {
    now_ += kSecond / 10;
    ++count_;
    Estimate e;
    const double wheel_mps = stationary_ ? 0.0 : speed_mps_;
    const double slip = slip_ + variation_ * dice_.normal();
    e.nav.stamp = now_;
    e.nav.q_b_to_n = q_b_to_n_fromEuler(0.02 * std::sin(0.1 * count_), 0.03 * std::cos(0.07 * count_), 0.01 * count_);
    e.motion = {0.1, Vector3(wheel_mps * (1.0 - slip), 0.0, 0.0), Vector3::Zero()};
    e.nav.v_eb_n = e.nav.q_b_to_n * e.motion.v_eb_b;
    e.nav.position.latitude_rad = 0.7;
    e.f_ib_b = Vector3(0.0, 0.0, -9.8);
    e.omega_ib_b.z() = dice_.from<double>({0.0, 0.005, 0.02});
    e.has_wheels = !dice_.oneIn(30);
    e.stationary = stationary_;
    e.wheel_speed_used = !stationary_ && dice_.oneIn(used_);
    e.wheels.stamp = now_;
    e.wheels.motion.forward_mps = wheel_mps;
    e.noise_factors = factors_;
    if (dice_.oneIn(200)) {
      e.motion.v_eb_b.x() = std::numeric_limits<double>::quiet_NaN();
    }
    return e;
  }

  static void note(const Forecast& forecast, ReferenceTrace& trace) {
    const std::vector<double>& bound_m = forecast.error.horizontal_bound_m;
    trace.note(toString(forecast.fit.status), forecast.fit.samples, forecast.fit.left_out, forecast.fit.evaluations,
               forecast.fit.log_marginal_likelihood, forecast.slip.mean.norm(), forecast.slip.stddev.norm(),
               forecast.slip.times_s.sum(), forecast.correlation.bias_stddev, forecast.correlation.stddev,
               forecast.correlation.time_constant_s);
    const GroundOutlook& ground = forecast.outlook;
    trace.note("  ", bound_m.front(), bound_m[bound_m.size() / 2], bound_m.back(), forecast.error.times_s.back(),
               forecast.error.time_to_stop_s, forecast.error.stop_distance_m, forecast.error.kept_s, ground.speed_mps,
               ground.wheel_speed_mps, ground.wheel_noise_variance, ground.wheel_share, ground.drift_std,
               ground.change_std, ground.change_time_s.value_or(-1.0), ground.side_slip_std_rad);
  }

  Dice dice_;
  ForecastMethod& method_;
  ForecastParams params_;
  ErrorCovariance P_ = ErrorCovariance::Zero();
  NoiseFactors factors_;
  Nanoseconds now_ = 1'600'000'000 * kSecond;
  int count_ = 0;
  bool stationary_ = false;
  double speed_mps_ = 0.8;
  double slip_ = 0.0;
  double variation_ = 0.0;
  int used_ = 1;
};

TEST(ForecasterReference, ForecastsAreTheSame) {
  ReferenceTrace trace("forecaster");
  ForecastParams params;
  params.window_s = 8.0;
  params.window_m = 5.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    params.bound = seed == 3 ? "absolute" : "growth";
    Forecaster forecaster(Planet::byName("earth"), Config().navigation().filter, params);
    ChangingDrive drive(forecaster, params, seed);
    for (int line = 0; line < 25; ++line) {
      drive.addLines(trace);
    }
  }
  trace.compare();
}

TEST(PaperForecasterReference, ForecastsAreTheSame) {
  ReferenceTrace trace("paper_forecaster");
  ForecastParams params;
  params.schedule = "paper";
  params.bound = "absolute";
  params.slip.model = "paper";
  params.sigma_points.form = "paper";
  params.window_s = 6.0;
  params.window_m = 4.0;
  params.threshold_m = 8.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    PaperForecaster forecaster(Planet::byName("earth"), Config().navigation().filter, params);
    ChangingDrive drive(forecaster, params, seed);
    for (int line = 0; line < 30; ++line) {
      drive.addLines(trace);
    }
  }
  trace.compare();
}

SlipSamples drawnSamples(Dice& dice) {
  SlipSamples samples;
  const int count = dice.from<int>({3, 14, 15, 40, 80, 150});
  const double interval_s = dice.from<double>({0.1, 0.5});
  const double size = dice.from<double>({0.0, 0.0003, 0.02, 0.1, 0.5});
  const double mean = dice.from<double>({0.0, 0.1, 0.4});
  const double rate = dice.from<double>({0.05, 0.4, 2.0});
  double time_s = dice.from<double>({0.0, 100.0});
  for (int i = 0; i < count; ++i) {
    time_s += interval_s * (dice.oneIn(30) ? 12.0 : 1.0);
    samples.times_s.push_back(dice.oneIn(60) ? time_s - 5.0 : time_s);
    const double slip = mean + size * (std::sin(rate * i) + 0.3 * dice.normal());
    samples.slips.push_back(dice.oneIn(60) ? std::numeric_limits<double>::quiet_NaN() : dice.oneIn(60) ? 1.0 : slip);
  }
  if (dice.oneIn(5)) {
    samples.origin_s = samples.times_s.front() + dice.from<double>({-3.0, 0.0, 0.01});
  }
  return samples;
}

TEST(SlipModelReference, FitsAndPredictionsAreTheSame) {
  ReferenceTrace trace("slip_model");
  for (const std::string inference : {"state_space", "dense"}) {
    for (const std::string name : {"rbf_slow", "paper", "ou_bias", "brownian_matern"}) {
      Dice dice(5);
      SlipModelParameters parameters;
      parameters.model = name;
      parameters.inference = inference;
      parameters.max_evaluations = name == "paper" ? 12 : 60;
      GaussianProcessSlipModel model(parameters);
      for (int i = 0; i < 12; ++i) {
        const SlipFit fit = model.fit(drawnSamples(dice));
        trace.note(name, toString(fit.status), fit.samples, fit.left_out, fit.evaluations, fit.origin_s,
                   fit.log_marginal_likelihood, fit.hyperparameter("variance"), fit.hyperparameter("noise_variance"));
        if (model.isReady()) {
          const GaussMarkovSlip summary = summarizeCorrelation(model, 400.0, 30.0, 31);
          const SlipPrediction prediction = model.predict(Eigen::VectorXd::LinSpaced(9, 300.0, 340.0));
          trace.note("  ", prediction.mean.norm(), prediction.stddev.norm(), summary.bias_stddev, summary.stddev);
        }
        if (i == 7) {
          model.reset();
        }
      }
    }
  }
  trace.compare();
}

}  // namespace
}  // namespace slipnav::test
