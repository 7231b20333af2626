/// Recordings, through the whole offline pipeline.

#include <stdexcept>

#include "fuzz_target.h"
#include "slipnav/ros/bag_evaluation.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const slipnav::fuzz::InputFile file(data, size);
  slipnav::Config config;
  config.initialization.source = "given";
  config.initialization.levelling_window_s = 0.5;
  try {
    slipnav::evaluateBag(file.path(), config, "", {});
  } catch (const std::invalid_argument&) {  // not a recording that can be used
  } catch (const std::runtime_error&) {     // no start found
  }
  return 0;
}
