#pragma once
/// What the benchmarks work on: a drive as long as the paper's longest, and slip. Made once, when first asked for.

#include <vector>

#include "config/config.h"
#include "core/forecast/slip_window.h"
#include "simulation/simulator.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav::bench {

/// The defaults, on rough ground.
const Config& config();

/// All samples of 915 s: rest, straight drive under satellite fixes, and then as far as the time goes without a stop.
const std::vector<sim::Measurements>& longDrive();

/// What a forecaster receives.
struct FilterOutput {
  Estimate estimate;
  ErrorCovariance P;
};

/// The filter's estimates with wheels on that drive.
const std::vector<FilterOutput>& filterOutputs();

/// Slip recorded on a real rover, played to and fro for as many samples.
SlipSamples realSlip(std::size_t count);

/// `count` samples from the one at `start` on.
SlipSamples windowOf(const SlipSamples& recording, std::size_t start, std::size_t count);

/// The value that a share of the values stays below; the values must not be empty.
double percentile(std::vector<double> values, double share);

/// Time that this thread has computed, so that other work on the machine does not count [ms].
double threadTime_ms();

}  // namespace slipnav::bench
