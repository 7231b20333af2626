#pragma once
/// One summary of all nodelets of a rover, from the status of each.

#include <diagnostic_msgs/DiagnosticArray.h>

#include <map>
#include <string>
#include <utility>

namespace slipnav {

/// Hardware id in the diagnostics of this package's nodelets, which distinguishes them from others.
inline constexpr const char* kHardwareId = "slipnav";

/// Name of the summary status, in the namespace of the nodelets.
inline constexpr const char* kFitToDrive = "fit to drive";

/// Rank of a status level by severity: unknown is less severe than wrong.
int severityOf(int level);

/// Keeps the newest status of each nodelet. Times are real time [s], of a monotonic clock.
class FitToDrive {
 public:
  /// @param name_space of the nodelets, as resolved by ROS; those of other rovers are ignored
  explicit FitToDrive(std::string name_space);

  /// Name of the summary status, which is ignored as well.
  const std::string& name() const { return name_; }

  void take(const diagnostic_msgs::DiagnosticArray& message, double now_s);

  /// Content of the status.
  struct Verdict {
    int level;  ///< as in diagnostic_msgs/DiagnosticStatus
    std::string message;
  };
  /// Worst first; a nodelet that has fallen silent is as bad as one that reports an error.
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
