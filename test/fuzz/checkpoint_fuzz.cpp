/// Checkpoints: damaged ones, and ones whose checksum is right but whose content is not.

#include <stdexcept>

#include "core/navigation/checkpoint.h"
#include "fuzz_target.h"

namespace {

void parse(const std::string& text) {
  try {
    const slipnav::Checkpoint checkpoint = slipnav::parseCheckpoint(text);
    if (!checkpoint.state.P.allFinite() || !slipnav::isFinite(checkpoint.state.nav)) {
      std::abort();
    }
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = slipnav::fuzz::toText(data, size);
  parse(text);
  const std::size_t checksum = text.rfind("checksum ");
  if (checksum != std::string::npos) {
    parse(slipnav::withChecksum(text.substr(0, checksum)));
  }
  return 0;
}
