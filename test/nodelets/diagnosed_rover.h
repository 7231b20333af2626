#pragma once
/// What nodelets say of themselves on `diagnostics`, for tests.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>

#include <map>
#include <string>

namespace slipnav {

/// The newest status of each nodelet.
class Diagnoses {
 public:
  explicit Diagnoses(ros::NodeHandle& node) {
    const boost::function<void(const diagnostic_msgs::DiagnosticArray::ConstPtr&)> take =
        [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& message) {
          for (const diagnostic_msgs::DiagnosticStatus& status : message->status) {
            statuses_[status.name.substr(status.name.rfind('/') + 1)] = status;
          }
        };
    subscriber_ = node.subscribe<diagnostic_msgs::DiagnosticArray>("diagnostics", 100, take);
  }

  /// @param nodelet as in the launch file
  const diagnostic_msgs::DiagnosticStatus& of(const std::string& nodelet) { return statuses_[nodelet]; }
  bool has(const std::string& nodelet) const { return statuses_.count(nodelet) > 0; }
  /// Whether it complains with these words.
  bool complains(const std::string& nodelet, const std::string& words) {
    return of(nodelet).level != diagnostic_msgs::DiagnosticStatus::OK &&
           of(nodelet).message.find(words) != std::string::npos;
  }
  /// Everything that is not OK, for messages.
  std::string complaints() const {
    std::string text;
    for (const auto& [name, status] : statuses_) {
      if (status.level != diagnostic_msgs::DiagnosticStatus::OK) {
        text += name + " (" + std::to_string(status.level) + "): " + status.message + "\n";
      }
    }
    return text;
  }

 private:
  ros::Subscriber subscriber_;
  std::map<std::string, diagnostic_msgs::DiagnosticStatus> statuses_;
};

}  // namespace slipnav
