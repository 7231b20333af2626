/// Trajectories in the format of TUM.

#include <stdexcept>

#include "evaluation/tum.h"
#include "fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const slipnav::fuzz::InputFile file(data, size);
  try {
    slipnav::readTum(file.path());
  } catch (const std::invalid_argument&) {
  } catch (const std::runtime_error&) {
  }
  return 0;
}
