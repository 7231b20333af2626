#pragma once
/// One word on all nodelets of a rover, from what each says of itself.

#include <diagnostic_msgs/DiagnosticArray.h>

#include <map>
#include <string>
#include <utility>

namespace slipnav {

/// What nodelets of this package give as the hardware of their diagnostics, by which they are told from others.
inline constexpr const char* kHardwareId = "slipnav";

/// Name of the status that sums up, in the namespace of the nodelets.
inline constexpr const char* kFitToDrive = "fit to drive";

/// The level of a status by how bad it is: what is not known is less so than what is wrong.
int severityOf(int level);

/// Keeps the newest status of each nodelet. Times are real ones [s], of a clock that only runs forward.
class FitToDrive {
 public:
  /// @param name_space of the nodelets, as ROS resolves it; those of other rovers are passed over
  explicit FitToDrive(std::string name_space);

  /// Name of the status that sums up, which is passed over as well.
  const std::string& name() const { return name_; }

  void take(const diagnostic_msgs::DiagnosticArray& message, double now_s);

  /// What the status says.
  struct Verdict {
    int level;  ///< as in diagnostic_msgs/DiagnosticStatus
    std::string message;
  };
  /// The worst first; a nodelet that has fallen silent is as bad as one that reports an error.
  Verdict verdict(double now_s) const;

 private:
  struct Heard {
    int level;
    std::string message;
    double time_s;
  };

  std::string prefix_;
  std::string name_;
  std::map<std::string, Heard> nodelets_;
};

}  // namespace slipnav
