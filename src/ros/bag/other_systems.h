#pragma once
/// Other systems' poses on the drive of a recording, to compare the estimate with.

#include <string>
#include <vector>

#include "evaluation/report.h"
#include "evaluation/tum.h"

namespace slipnav {

/// One of them by its name.
struct OtherSystem {
  std::string name;
  std::vector<TumPose> poses;
};

/// @param arguments NAME=TOPIC or NAME=FILE.tum, the name of letters, digits, _ and -
/// @param parts of the recording that has the topics
/// @param folder where relative files are; "": the working directory
/// Throws UsageError, and std::invalid_argument for a topic or file that has no poses.
std::vector<OtherSystem> readOtherSystems(const std::vector<std::string>& arguments,
                                          const std::vector<std::string>& parts, const std::string& folder = "");

/// Places each beside the estimate of a report.
void addOtherSystems(const std::vector<OtherSystem>& systems, RunReport& report);

}  // namespace slipnav
