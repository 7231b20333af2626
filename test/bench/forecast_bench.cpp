/// Cost of forecasts: a window fitted after a warm start, predictions, and the growth of the error over the horizon.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "bench_drive.h"
#include "core/forecast/gaussian_process_slip_model.h"
#include "core/forecast/slip_correlation.h"
#include "slipnav/core/ekf/error_dynamics.h"

namespace slipnav::bench {
namespace {

constexpr double kInterval_s = 0.1;
constexpr double kHorizon_s = 60.0;
constexpr Eigen::Index kPredictions = 600;
constexpr int kCovarianceSteps = 3000;  // at 50 Hz over the horizon
constexpr int kStepsPerWheelSample = 5;
constexpr std::size_t kWindow = 150;
constexpr std::size_t kStride = 10;        // windows slide by one second
constexpr std::size_t kRealWindows = 298;  // all different
constexpr int kSimulatedWindows = 600;
constexpr double kDenseLimit_us = 10e3;
constexpr double kStateSpaceLimit_us = 5e3;

SlipModelParameters parametersOf(const std::string& model, const std::string& inference) {
  SlipModelParameters parameters;
  parameters.model = model;
  parameters.inference = inference;
  return parameters;
}

/// The paper's propagation (section IV-D): the covariance with the last Φ and Q, every fifth step updated by odometry.
class CovarianceAhead {
 public:
  CovarianceAhead() : odometry_(3), P_(ErrorCovariance::Zero()) {
    const Planet planet = Planet::byName(config().planet);
    const ErrorDynamics dynamics(planet, config().imu.noise, config().vehicle);
    NavigationState state;
    state.position.latitude_rad = degToRad(config().initialization.latitude_deg);
    state.v_eb_n.x() = 0.8;
    const Vector3 f_ib_b = -planet.gravity_n(state.position);
    transition_ = dynamics.transition(state, state, f_ib_b, Vector3::Zero(), kHorizon_s / kCovarianceSteps);
    P_.diagonal() = dynamics.priorVariance().array() + 1e-6;
    odometry_.H.block<3, 3>(0, kVelocity).setIdentity();
    odometry_.H(0, kSlowSlip) = odometry_.H(0, kFastSlip) = 0.8;
    odometry_.variance << 1e-4, 1e-4, 1e-4;
  }

  /// @param wheel_variance of the odometry's forward speed, from the slip predicted
  double stdAtHorizon(double wheel_variance) {
    ErrorCovariance P = P_;
    odometry_.variance(0) = wheel_variance;
    for (int step = 1; step <= kCovarianceSteps; ++step) {
      ErrorDynamics::propagate(transition_, P);
      if (step % kStepsPerWheelSample == 0) {
        benchmark::DoNotOptimize(kalmanUpdate(odometry_, P));
      }
    }
    return P(kPosition, kPosition);
  }

 private:
  Measurement odometry_;
  ErrorTransition transition_;
  ErrorCovariance P_;
};

SlipPrediction predictHorizon(const GaussianProcessSlipModel& model, double last_s) {
  return model.predict(Eigen::VectorXd::LinSpaced(kPredictions, last_s + kInterval_s, last_s + kHorizon_s));
}

/// Fit of a window, 600 predictions, 3000 covariance steps. A function of its own for profilers to count.
__attribute__((noinline)) void forecastOnce(GaussianProcessSlipModel& model, CovarianceAhead& covariance,
                                            const SlipSamples& window) {
  model.fit(window);
  const SlipPrediction slip = predictHorizon(model, window.times_s.back());
  benchmark::DoNotOptimize(covariance.stdAtHorizon(1e-4 + slip.stddev.squaredNorm() / kPredictions));
}

std::size_t windowsIn(const SlipSamples& recording) { return (recording.times_s.size() - kWindow) / kStride; }

/// All windows of a recording one after another; p50_us and p99_us of what each of them takes.
void wholeForecast(benchmark::State& state, const SlipSamples& recording, const SlipModelParameters& parameters) {
  GaussianProcessSlipModel model(parameters);
  CovarianceAhead covariance;
  model.fit(windowOf(recording, 0, kWindow));
  std::vector<double> times_us;
  std::size_t window = 0;
  for (auto _ : state) {
    const SlipSamples samples = windowOf(recording, kStride * (window++ % windowsIn(recording)), kWindow);
    const double begin_ms = threadTime_ms();
    forecastOnce(model, covariance, samples);
    times_us.push_back(1e3 * (threadTime_ms() - begin_ms));
  }
  state.counters["p50_us"] = percentile(times_us, 0.5);
  state.counters["p99_us"] = percentile(times_us, 0.99);
  state.counters["windows"] = static_cast<double>(windowsIn(recording));
  state.counters["limit_us"] = parameters.inference == "dense" ? kDenseLimit_us : kStateSpaceLimit_us;
}

void wholeForecastReal(benchmark::State& state, const std::string& model, const std::string& inference) {
  wholeForecast(state, realSlip(kWindow + kStride * kRealWindows), parametersOf(model, inference));
}

void wholeForecastSimulated(benchmark::State& state, const std::string& model, const std::string& inference) {
  wholeForecast(state, simulatedSlip(), parametersOf(model, inference));
}

/// Warm fits of windows of `count` samples, in all [ms].
double fitAll(const SlipSamples& recording, std::size_t count, std::size_t windows, const std::string& model_name) {
  GaussianProcessSlipModel model(parametersOf(model_name, "state_space"));
  model.fit(windowOf(recording, 0, count));
  const double begin_ms = threadTime_ms();
  for (std::size_t window = 0; window < windows; ++window) {
    benchmark::DoNotOptimize(model.fit(windowOf(recording, kStride * window, count)).log_marginal_likelihood);
  }
  return threadTime_ms() - begin_ms;
}

/// How the fit's cost grows from a window of 150 samples to one of 1500.
void fitGrowth(benchmark::State& state, const std::string& model) {
  constexpr std::size_t kGrown = 10 * kWindow;
  constexpr std::size_t kWindows = 100;
  const SlipSamples recording = realSlip(kGrown + kStride * kWindows);
  double least_ms = std::numeric_limits<double>::infinity();
  double least_grown_ms = least_ms;
  for (auto _ : state) {
    least_ms = std::min(least_ms, fitAll(recording, kWindow, kWindows, model));
    least_grown_ms = std::min(least_grown_ms, fitAll(recording, kGrown, kWindows, model));
  }
  state.counters["ratio"] = least_grown_ms / least_ms;
  state.counters["limit_ratio"] = 12.0;
}

void coldFit(benchmark::State& state, const std::string& inference) {
  const SlipSamples samples = realSlip(kWindow);
  for (auto _ : state) {
    GaussianProcessSlipModel model(parametersOf("paper", inference));
    benchmark::DoNotOptimize(model.fit(samples).log_marginal_likelihood);
  }
}

void correlationSummary(benchmark::State& state, const std::string& inference) {
  GaussianProcessSlipModel model(parametersOf("paper_bias", inference));
  const SlipSamples samples = realSlip(kWindow);
  model.fit(samples);
  for (auto _ : state) {
    benchmark::DoNotOptimize(summarizeCorrelation(model, samples.times_s.back(), kHorizon_s).stddev);
  }
}

#define SLIPNAV_WHOLE_FORECAST(model, inference)                                     \
  BENCHMARK_CAPTURE(wholeForecastReal, model##_##inference, #model, #inference)      \
      ->Unit(benchmark::kMillisecond)                                                \
      ->Iterations(kRealWindows);                                                    \
  BENCHMARK_CAPTURE(wholeForecastSimulated, model##_##inference, #model, #inference) \
      ->Unit(benchmark::kMillisecond)                                                \
      ->Iterations(kSimulatedWindows)

SLIPNAV_WHOLE_FORECAST(paper, dense);
SLIPNAV_WHOLE_FORECAST(rbf_slow, dense);
SLIPNAV_WHOLE_FORECAST(paper, state_space);
SLIPNAV_WHOLE_FORECAST(brownian_matern, state_space);
SLIPNAV_WHOLE_FORECAST(rbf_slow, state_space);
BENCHMARK_CAPTURE(fitGrowth, brownian_matern, "brownian_matern")->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK_CAPTURE(fitGrowth, paper, "paper")->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK_CAPTURE(fitGrowth, rbf_slow, "rbf_slow")->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK_CAPTURE(coldFit, paper_dense, "dense")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(coldFit, paper_state_space, "state_space")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(correlationSummary, dense, "dense")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(correlationSummary, state_space, "state_space")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slipnav::bench
