#include "ros/bag/other_systems.h"

#include <algorithm>
#include <cctype>

#include "config/command_line.h"
#include "evaluation/other_track.h"
#include "ros/bag/bag_poses.h"

namespace slipnav {
namespace {

bool isName(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  });
}

bool isTumFile(const std::string& source) {
  constexpr const char* kEnding = ".tum";
  return source.size() > 4 && source.compare(source.size() - 4, 4, kEnding) == 0;
}

std::string pathOf(const std::string& file, const std::string& folder) {
  return folder.empty() || file.front() == '/' ? file : folder + "/" + file;
}

}  // namespace

std::vector<OtherSystem> readOtherSystems(const std::vector<std::string>& arguments,
                                          const std::vector<std::string>& parts, const std::string& folder) {
  std::vector<OtherSystem> systems;
  for (const std::string& text : arguments) {
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    if (equals == std::string::npos || equals + 1 == text.size() || !isName(name)) {
      throw UsageError("--compare takes NAME=TOPIC or NAME=FILE.tum, the name of letters, digits, _ and -: '" + text +
                       "'");
    }
    if (std::any_of(systems.begin(), systems.end(), [&name](const auto& other) { return other.name == name; })) {
      throw UsageError("--compare has the name '" + name + "' twice");
    }
    const std::string source = text.substr(equals + 1);
    systems.push_back({name, isTumFile(source) ? readTum(pathOf(source, folder)) : readPoses(parts, source)});
  }
  return systems;
}

void addOtherSystems(const std::vector<OtherSystem>& systems, RunReport& report) {
  for (const OtherSystem& system : systems) {
    report.others.push_back(besideTheEstimate(system.name, system.poses, report.estimates, report.truth));
  }
}

}  // namespace slipnav
