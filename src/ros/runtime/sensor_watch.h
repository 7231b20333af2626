#pragma once
/// Whether a sensor publishes, and whether its samples are usable.

#include <string>
#include <utility>

#include "core/base/silence_watch.h"

namespace slipnav {

/// For one sensor, in the nodelet that needs it.
class SensorWatch {
 public:
  /// @param name of the sensor; @param limit_s how long it may be silent
  SensorWatch(std::string name, double limit_s) : name_(std::move(name)), used_(limit_s), heard_(limit_s) {}

  /// A usable sample has arrived.
  void used(const SilenceWatch::Now& now) {
    used_.heard(now);
    heard_.heard(now);
    refusal_.clear();
  }
  /// An unusable message has arrived.
  void refused(const std::string& why, const SilenceWatch::Now& now) {
    if (!used_.hasHeard()) {
      used_.heard(now);  // from the first message on, samples are due
    }
    heard_.heard(now);
    refusal_ = why;
  }

  /// What is wrong, with the cause; "" while samples arrive, and before the first message.
  /// @param topic on which samples are expected
  std::string problem(const std::string& topic, const SilenceWatch::Now& now) const {
    if (!used_.isSilent(now)) {
      return "";
    }
    return heard_.isSilent(now) || refusal_.empty() ? name_ + " silent: nothing usable on " + topic
                                                    : "no usable samples of " + name_ + ": " + refusal_;
  }

 private:
  std::string name_;
  SilenceWatch used_;
  SilenceWatch heard_;
  std::string refusal_;  ///< of the newest message; "" if it was usable
};

}  // namespace slipnav
