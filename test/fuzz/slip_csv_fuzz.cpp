/// Tables of slip, as the command `forecast` takes them, and the forecast of the short ones.

#include <cstdlib>
#include <stdexcept>

#include "evaluation/slip_forecast.h"
#include "fuzz_target.h"

namespace {

constexpr std::size_t kFewSamples = 12;
constexpr double kHorizon_s = 1.0;

void forecast(const slipnav::SlipSamples& samples) {
  slipnav::SlipModelParameters parameters;
  parameters.inference = "state_space";
  parameters.min_samples = 3;
  parameters.max_evaluations = 5;
  const slipnav::SlipForecastResult result = slipnav::forecastSlip(samples, parameters, kHorizon_s);
  if (!result.prediction.mean.allFinite() || !result.prediction.stddev.allFinite()) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const slipnav::fuzz::InputFile file(data, size);
  try {
    const slipnav::SlipSamples samples = slipnav::readSlipCsv(file.path());
    if (samples.slips.size() <= kFewSamples) {
      forecast(samples);
    }
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
