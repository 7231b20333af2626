/// RTKLIB solutions.

#include <sstream>
#include <stdexcept>

#include "fuzz_target.h"
#include "io/rtklib_pos.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream text(slipnav::fuzz::toText(data, size));
  try {
    slipnav::readRtklibPos(text, "input");
  } catch (const std::runtime_error&) {  // names the line that is wrong
  }
  return 0;
}
