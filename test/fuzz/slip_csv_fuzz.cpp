/// Tables of slip, as the command `forecast` takes them.

#include <stdexcept>

#include "fuzz_target.h"
#include "slipnav/forecast/slip_forecast.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const slipnav::fuzz::InputFile file(data, size);
  try {
    slipnav::readSlipCsv(file.path());
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
