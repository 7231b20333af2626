/// Recordings, through the offline pipeline and the calibration. Estimates that come out must be finite.

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "fuzz_target.h"
#include "ros/bag/bag_calibration.h"
#include "ros/bag/bag_evaluation.h"

namespace {

slipnav::Config makeConfig(const std::string& extrinsics) {
  slipnav::Config config;
  config.initialization.source = "given";
  config.initialization.leveling_window_s = 0.5;
  config.frames.extrinsics = extrinsics;
  return config;
}

const slipnav::Config& configFor(const std::string& recording) {
  static const slipnav::Config by_parameters = makeConfig("parameters");
  static const slipnav::Config by_tf = makeConfig("tf");
  return recording.find("tf_static") == std::string::npos ? by_parameters : by_tf;
}

bool isFinite(const slipnav::EstimateSample& estimate) {
  return estimate.position_enu_m.allFinite() && estimate.covariance_enu_m2.allFinite() &&
         estimate.q_flu_to_enu.coeffs().allFinite();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const slipnav::Config& config = configFor(slipnav::fuzz::toText(data, size));
  const slipnav::fuzz::InputFile file(data, size);
  try {
    const slipnav::EstimateTrack estimates = slipnav::evaluateBag(file.path(), config, "", {}).report.estimates;
    if (!std::all_of(estimates.begin(), estimates.end(), isFinite)) {
      std::abort();
    }
    slipnav::calibrateBag(file.path(), config, "", {});
  } catch (const std::invalid_argument&) {  // not a recording that can be used
  } catch (const std::runtime_error&) {     // no start found
  }
  return 0;
}
