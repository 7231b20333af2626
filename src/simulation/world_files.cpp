#include "simulation/world_files.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace slipnav::sim {
namespace {

constexpr const char* kExtension = ".yaml";

}  // namespace

std::vector<std::string> configurationsIn(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(folder, missing)) {
    if (entry.path().extension() == kExtension) {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string configurationNamed(const std::string& name, const std::string& folder, const std::string& what) {
  const std::vector<std::string> names = configurationsIn(folder);
  if (std::find(names.begin(), names.end(), name) != names.end()) {
    return (std::filesystem::path(folder) / (name + kExtension)).string();
  }
  std::string known;
  for (const std::string& candidate : names) {
    known += (known.empty() ? "" : ", ") + candidate;
  }
  throw std::invalid_argument(what + " '" + name + "' is not known (" + known + ")");
}

}  // namespace slipnav::sim
