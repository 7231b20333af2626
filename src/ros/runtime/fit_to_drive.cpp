#include "ros/runtime/fit_to_drive.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace slipnav {
namespace {

using diagnostic_msgs::DiagnosticStatus;

/// Of a status published twice a second, on a busy machine.
constexpr double kLifetime_s = 2.0;

/// A status has the name of its process before that of the nodelet.
std::string nodeletOf(const std::string& name) {
  const std::size_t colon = name.find(": ");
  return colon == std::string::npos ? name : name.substr(colon + 2);
}

}  // namespace

int severityOf(int level) {
  return level == DiagnosticStatus::ERROR ? 3 : level == DiagnosticStatus::STALE ? 2 : level;
}

FitToDrive::FitToDrive(std::string name_space)
    : prefix_(name_space.back() == '/' ? std::move(name_space) : std::move(name_space) + "/"),
      name_(prefix_ + kFitToDrive) {}

void FitToDrive::take(const diagnostic_msgs::DiagnosticArray& message, double now_s) {
  for (const DiagnosticStatus& status : message.status) {
    const std::string nodelet = nodeletOf(status.name);
    const bool is_ours = status.hardware_id == kHardwareId && nodelet.compare(0, prefix_.size(), prefix_) == 0 &&
                         nodelet.find('/', prefix_.size()) == std::string::npos && nodelet != name_;
    if (is_ours) {
      nodelets_[nodelet.substr(prefix_.size())] = {status.level, status.message, now_s};
    }
  }
}

FitToDrive::Verdict FitToDrive::verdict(double now_s) const {
  std::vector<std::tuple<int, std::string, int>> problems;
  for (const auto& [nodelet, heard] : nodelets_) {
    if (now_s - heard.time_s > kLifetime_s) {
      problems.emplace_back(-severityOf(DiagnosticStatus::ERROR), nodelet + " has stopped reporting",
                            DiagnosticStatus::ERROR);
    } else if (heard.level != DiagnosticStatus::OK) {
      problems.emplace_back(-severityOf(heard.level), nodelet + ": " + heard.message, heard.level);
    }
  }
  if (nodelets_.empty()) {
    return {DiagnosticStatus::WARN, "no nodelet has reported yet"};
  }
  if (problems.empty()) {
    return {DiagnosticStatus::OK, kFitToDrive};
  }
  std::sort(problems.begin(), problems.end());
  const int worst = std::get<2>(problems.front());
  std::string words = worst == DiagnosticStatus::WARN ? "fit to drive with limits" : "not fit to drive";
  const char* separator = ": ";
  for (const auto& [order, text, level] : problems) {
    words += separator + text;
    separator = "; ";
  }
  return {worst, words};
}

}  // namespace slipnav
