/// Recordings, through the offline pipeline and the calibration.

#include <stdexcept>

#include "fuzz_target.h"
#include "slipnav/ros/bag_calibration.h"
#include "slipnav/ros/bag_evaluation.h"

namespace {

slipnav::Config makeConfig() {
  slipnav::Config config;
  config.initialization.source = "given";
  config.initialization.levelling_window_s = 0.5;
  return config;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const slipnav::Config config = makeConfig();
  const slipnav::fuzz::InputFile file(data, size);
  try {
    slipnav::evaluateBag(file.path(), config, "", {});
    slipnav::calibrateBag(file.path(), config, "", {});
  } catch (const std::invalid_argument&) {  // not a recording that can be used
  } catch (const std::runtime_error&) {     // no start found
  }
  return 0;
}
