/// Cost of a slip forecast: fit of a window after a warm start, and 600 predictions.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include "slipnav/forecast/gaussian_process_slip_model.h"
#include "slipnav/forecast/slip_correlation.h"
#include "support/gp_golden.h"

namespace slipnav {
namespace {

constexpr double kInterval_s = 0.1;
constexpr double kHorizon_s = 60.0;
constexpr Eigen::Index kPredictions = 600;

/// The recorded slip, mirrored at its ends as often as needed, so that there are windows to slide over.
SlipSamples longRecording(std::size_t count) {
  const std::vector<double> slips = readGpSlip().slips;
  const std::size_t period = 2 * slips.size();
  SlipSamples samples;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t phase = i % period;
    samples.times_s.push_back(kInterval_s * static_cast<double>(i));
    samples.slips.push_back(slips[phase < slips.size() ? phase : period - 1 - phase]);
  }
  return samples;
}

SlipSamples windowOf(const SlipSamples& recording, std::size_t start, std::size_t count) {
  const auto from = static_cast<std::ptrdiff_t>(start);
  const auto to = static_cast<std::ptrdiff_t>(start + count);
  return {{recording.times_s.begin() + from, recording.times_s.begin() + to},
          {recording.slips.begin() + from, recording.slips.begin() + to},
          {}};
}

SlipModelParameters parametersOf(const std::string& model, const std::string& inference) {
  SlipModelParameters parameters;
  parameters.model = model;
  parameters.inference = inference;
  return parameters;
}

double percentile(std::vector<double> values, double share) {
  const auto index = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

/// Time that this thread has computed, so that other work on the machine does not count [ms].
double threadTime_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// Windows of `range(0)` samples that slide by one second; counters p50_ms and p99_ms over the iterations.
void warmForecast(benchmark::State& state, const std::string& model_name, const std::string& inference) {
  const auto count = static_cast<std::size_t>(state.range(0));
  constexpr std::size_t kStride = 10;
  constexpr std::size_t kWindows = 60;
  const SlipSamples recording = longRecording(count + kStride * kWindows);
  GaussianProcessSlipModel model(parametersOf(model_name, inference));
  model.fit(windowOf(recording, 0, count));
  std::vector<double> times_ms;
  std::size_t window = 0;
  double evaluations = 0.0;
  for (auto _ : state) {
    const SlipSamples samples = windowOf(recording, kStride * (window++ % kWindows), count);
    const double begin_ms = threadTime_ms();
    const SlipFit fit = model.fit(samples);
    const double last_s = samples.times_s.back();
    const SlipPrediction prediction =
        model.predict(Eigen::VectorXd::LinSpaced(kPredictions, last_s + kInterval_s, last_s + kHorizon_s));
    benchmark::DoNotOptimize(prediction.mean.data());
    times_ms.push_back(threadTime_ms() - begin_ms);
    evaluations += fit.evaluations;
  }
  state.counters["p50_ms"] = percentile(times_ms, 0.5);
  state.counters["p99_ms"] = percentile(times_ms, 0.99);
  state.counters["evaluations"] = evaluations / static_cast<double>(times_ms.size());
}

void coldFit(benchmark::State& state, const std::string& inference) {
  const SlipSamples samples = windowOf(longRecording(150), 0, 150);
  for (auto _ : state) {
    GaussianProcessSlipModel model(parametersOf("paper", inference));
    benchmark::DoNotOptimize(model.fit(samples).log_marginal_likelihood);
  }
}

void correlationSummary(benchmark::State& state, const std::string& inference) {
  GaussianProcessSlipModel model(parametersOf("paper_bias", inference));
  const SlipSamples samples = longRecording(150);
  model.fit(samples);
  for (auto _ : state) {
    benchmark::DoNotOptimize(summarizeCorrelation(model, samples.times_s.back(), kHorizon_s).stddev);
  }
}

BENCHMARK_CAPTURE(warmForecast, paper_dense, "paper", "dense")->Arg(150)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(warmForecast, paper_state_space, "paper", "state_space")
    ->Arg(150)
    ->Arg(1500)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(warmForecast, brownian_matern_state_space, "brownian_matern", "state_space")
    ->Arg(150)
    ->Arg(1500)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(warmForecast, paper_bias_dense, "paper_bias", "dense")->Arg(150)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(warmForecast, ou_slow_state_space, "ou_slow", "state_space")->Arg(150)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(coldFit, paper_dense, "dense")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(coldFit, paper_state_space, "state_space")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(correlationSummary, dense, "dense")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(correlationSummary, state_space, "state_space")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace slipnav
