/// Configuration files.

#include <stdexcept>

#include "fuzz_target.h"
#include "slipnav/config/config.h"
#include "slipnav/config/yaml_document.h"
#include "slipnav/config/yaml_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    slipnav::Config config;
    slipnav::readParameters(slipnav::parseYaml(slipnav::fuzz::toText(data, size), "input"), config);
    config.navigation();
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
