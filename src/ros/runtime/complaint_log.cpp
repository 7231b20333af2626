#include "ros/runtime/complaint_log.h"

namespace slipnav {
namespace {

constexpr double kReminder_s = 60.0;
constexpr std::size_t kMostKnown = 1000;  // if each has another number in it

}  // namespace

std::string ComplaintLog::add(const std::string& complaint, double now_s) {
  const auto known = known_.find(complaint);
  if (known == known_.end()) {
    if (known_.size() >= kMostKnown) {
      known_.clear();
    }
    known_[complaint] = {now_s, 0};
    return complaint;
  }
  ++known->second.since;
  if (now_s - known->second.logged_s < kReminder_s) {
    return "";
  }
  const std::size_t count = known->second.since;
  known->second = {now_s, 0};
  return complaint + " (" + std::to_string(count) + " times since it was last said)";
}

}  // namespace slipnav
