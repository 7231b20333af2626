#include "ros/runtime/stop_latch_keeper.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "core/base/atomic_file.h"

namespace slipnav {
namespace {

constexpr const char* kNowhere = "none";

/// As roscpp finds it; "" if there is none.
std::string rosHome() {
  if (const char* home = std::getenv("ROS_HOME"); home != nullptr && *home != '\0') {
    return home;
  }
  const char* home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? std::string(home) + "/.ros" : "";
}

std::string placeFor(const CheckpointParams& params, std::string node) {
  if (!params.stop_file.empty()) {
    return params.stop_file == kNowhere ? "" : params.stop_file;
  }
  if (!params.file.empty()) {  // not next to that of a launch, which the stop outlasts
    return params.file + ".stop";
  }
  std::replace(node.begin(), node.end(), '/', '_');
  const std::string folder = rosHome();
  return folder.empty() ? "" : folder + "/slipnav" + node + ".stop";
}

}  // namespace

StopLatchKeeper::StopLatchKeeper(const CheckpointParams& params, const std::string& node)
    : file_(placeFor(params, node)) {}

StopLatch StopLatchKeeper::load() {
  if (file_.empty()) {
    return {};
  }
  const LoadedStopLatch loaded = loadStopLatch(file_);
  problem_ = loaded.problem;
  return loaded.latch;
}

std::string StopLatchKeeper::save(const StopLatch& latch) {
  if (file_.empty()) {
    return "checkpoint.stop_file names no file";
  }
  try {
    const std::string folder = std::filesystem::path(file_).parent_path();
    if (!folder.empty()) {
      createDirectories(folder);
    }
    saveStopLatch(file_, latch);
    problem_.clear();
  } catch (const std::exception& error) {
    problem_ = error.what();
  }
  return problem_;
}

}  // namespace slipnav
