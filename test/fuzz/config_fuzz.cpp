/// Configuration files.

#include <stdexcept>

#include "config/config.h"
#include "config/yaml_document.h"
#include "config/yaml_reader.h"
#include "fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    slipnav::Config config;
    slipnav::readParameters(slipnav::parseYaml(slipnav::fuzz::toText(data, size), "input"), config);
    config.navigation();
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
