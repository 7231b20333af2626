/// Recordings, through the check. It says something of each, and what it writes is a configuration.

#include <cstdlib>
#include <stdexcept>

#include "config/yaml_document.h"
#include "config/yaml_reader.h"
#include "fuzz_target.h"
#include "inspection/configuration_proposal.h"
#include "inspection/inspection.h"
#include "ros/bag/bag_inspection.h"

namespace {

/// A configuration that cannot be read ends the target.
void requireConfiguration(const std::string& yaml) {
  try {
    slipnav::Config config;
    slipnav::readParameters(slipnav::parseYaml(yaml, "proposal"), config);
    config.navigation();
  } catch (const std::exception&) {
    std::abort();
  }
}

void inspectWith(const slipnav::Recording& recording, const slipnav::InspectionOptions& options) {
  const slipnav::Inspection inspection = slipnav::inspect(recording, options);
  if (slipnav::toText(inspection.findings).empty() || slipnav::topicTable(recording, inspection.roles).empty()) {
    std::abort();
  }
  requireConfiguration(slipnav::proposedYaml(inspection, options, "a drive.bag"));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const slipnav::fuzz::InputFile file(data, size);
  slipnav::Recording recording;
  try {
    recording = slipnav::readRecording({file.path()});
  } catch (const std::invalid_argument&) {  // not a recording; the message says so
    return 0;
  } catch (const std::runtime_error&) {  // likewise
    return 0;
  }
  slipnav::InspectionOptions options;
  if (!recording.imus.empty()) {
    options.tf = slipnav::poseByTransforms(recording, slipnav::FrameNames{}.base, recording.imus.front().frame);
  }
  inspectWith(recording, options);
  options.wheel_radius_m = 0.1;
  inspectWith(recording, options);
  options.config = slipnav::Config{};
  inspectWith(recording, options);
  return 0;
}
