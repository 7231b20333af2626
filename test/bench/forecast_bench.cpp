/// Cost of forecasts, as a whole and of their fits.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "bench_drive.h"
#include "core/forecast/forecaster.h"
#include "core/forecast/gaussian_process_slip_model.h"
#include "core/forecast/slip_correlation.h"

namespace slipnav::bench {
namespace {

constexpr double kHorizon_s = 60.0;
constexpr std::size_t kWindow = 150;
constexpr std::size_t kStride = 10;        // windows slide by one second
constexpr std::size_t kRealWindows = 298;  // all different
constexpr int kForecasts = 800;
constexpr double kStateSpaceMedianLimit_us = 1e3;
constexpr double kStateSpaceLimit_us = 2e3;
constexpr double kDenseMedianLimit_us = 2e3;
constexpr double kDenseLimit_us = 4e3;
constexpr double kLargestGrowth = 9.0;

SlipModelParameters parametersOf(const std::string& model, const std::string& inference) {
  SlipModelParameters parameters;
  parameters.model = model;
  parameters.inference = inference;
  return parameters;
}

ForecastParams forecastOf(const std::string& inference, double lengthening = 1.0) {
  ForecastParams params = config().forecast;
  params.slip.inference = inference;
  params.window_s *= lengthening;
  params.window_m *= lengthening;
  return params;
}

/// The long drive, forecast by forecast.
class ForecastDrive {
 public:
  explicit ForecastDrive(const ForecastParams& params)
      : forecaster_(Planet::byName(config().planet), config().navigation().filter, params) {}

  /// The newest forecast's time [ms], that of the estimates before it not counted.
  double next() {
    for (;;) {
      const FilterOutput& output = filterOutputs()[next_];
      next_ = (next_ + 1) % filterOutputs().size();
      const double begin_ms = threadTime_ms();
      const bool made = push(output);
      if (made) {
        return threadTime_ms() - begin_ms;
      }
    }
  }

  /// Forecasts the drive until the window is full.
  void warmUp(double window_s) {
    for (double made_s = 0.0; made_s < window_s; made_s += config().forecast.interval_s) {
      next();
    }
  }

 private:
  /// A function of its own for profilers to count.
  __attribute__((noinline)) bool push(const FilterOutput& output) {
    const std::optional<Forecast> forecast = forecaster_.push(output.estimate, output.P);
    return forecast.has_value();
  }

  Forecaster forecaster_;
  std::size_t next_ = 0;
};

/// What the product runs: one forecast after the other of a drive; p50_us and p99_us of what each of them takes.
void wholeForecast(benchmark::State& state, const std::string& inference) {
  ForecastDrive drive(forecastOf(inference));
  drive.warmUp(config().forecast.window_s);
  std::vector<double> times_us;
  for (auto _ : state) {
    times_us.push_back(1e3 * drive.next());
  }
  const bool dense = inference == "dense";
  state.counters["p50_us"] = percentile(times_us, 0.5);
  state.counters["p99_us"] = percentile(times_us, 0.99);
  state.counters["limit_p50_us"] = dense ? kDenseMedianLimit_us : kStateSpaceMedianLimit_us;
  state.counters["limit_us"] = dense ? kDenseLimit_us : kStateSpaceLimit_us;
}

/// How the cost of a forecast grows from a window of 150 samples to one of 1500.
void forecastGrowth(benchmark::State& state) {
  constexpr double kLonger = 10.0;
  constexpr int kForecasts = 100;
  double least_ms = std::numeric_limits<double>::infinity();
  double least_grown_ms = least_ms;
  const auto timeOf = [](double longer) {
    ForecastDrive drive(forecastOf("state_space", longer));
    drive.warmUp(longer * config().forecast.window_s);
    double sum_ms = 0.0;
    for (int i = 0; i < kForecasts; ++i) {
      sum_ms += drive.next();
    }
    return sum_ms;
  };
  for (auto _ : state) {
    least_ms = std::min(least_ms, timeOf(1.0));
    least_grown_ms = std::min(least_grown_ms, timeOf(kLonger));
  }
  state.counters["ratio"] = least_grown_ms / least_ms;
  state.counters["limit_ratio"] = kLargestGrowth;
}

/// Warm fits of windows of real slip, all different.
void warmFit(benchmark::State& state, const std::string& model_name, const std::string& inference) {
  GaussianProcessSlipModel model(parametersOf(model_name, inference));
  const SlipSamples recording = realSlip(kWindow + kStride * kRealWindows);
  model.fit(windowOf(recording, 0, kWindow));
  std::vector<double> times_us;
  std::size_t window = 0;
  for (auto _ : state) {
    const SlipSamples samples = windowOf(recording, kStride * (window++ % kRealWindows), kWindow);
    const double begin_ms = threadTime_ms();
    benchmark::DoNotOptimize(model.fit(samples).log_marginal_likelihood);
    times_us.push_back(1e3 * (threadTime_ms() - begin_ms));
  }
  state.counters["p50_us"] = percentile(times_us, 0.5);
  state.counters["p99_us"] = percentile(times_us, 0.99);
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
  state.counters["limit_ratio"] = kLargestGrowth;
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

BENCHMARK_CAPTURE(wholeForecast, state_space, "state_space")->Unit(benchmark::kMillisecond)->Iterations(kForecasts);
BENCHMARK_CAPTURE(wholeForecast, dense, "dense")->Unit(benchmark::kMillisecond)->Iterations(kForecasts);
BENCHMARK(forecastGrowth)->Unit(benchmark::kMillisecond)->Iterations(3);

#define SLIPNAV_WARM_FIT(model, inference)                            \
  BENCHMARK_CAPTURE(warmFit, model##_##inference, #model, #inference) \
      ->Unit(benchmark::kMillisecond)                                 \
      ->Iterations(kRealWindows)

SLIPNAV_WARM_FIT(paper, dense);
SLIPNAV_WARM_FIT(rbf_slow, dense);
SLIPNAV_WARM_FIT(paper, state_space);
SLIPNAV_WARM_FIT(brownian_matern, state_space);
SLIPNAV_WARM_FIT(rbf_slow, state_space);
BENCHMARK_CAPTURE(fitGrowth, brownian_matern, "brownian_matern")->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK_CAPTURE(fitGrowth, paper, "paper")->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK_CAPTURE(fitGrowth, rbf_slow, "rbf_slow")->Unit(benchmark::kMillisecond)->Iterations(3);
BENCHMARK_CAPTURE(coldFit, paper_dense, "dense")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(coldFit, paper_state_space, "state_space")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(correlationSummary, dense, "dense")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(correlationSummary, state_space, "state_space")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slipnav::bench
