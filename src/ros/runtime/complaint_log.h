#pragma once
/// What goes into the log of complaints that may come with every message.

#include <cstddef>
#include <map>
#include <string>

namespace slipnav {

/// Each complaint goes into the log at once, and while it keeps coming again every minute, with its count.
class ComplaintLog {
 public:
  /// @param now_s of a monotonic clock
  /// @return the line for the log, "" for none
  std::string add(const std::string& complaint, double now_s);

 private:
  struct Known {
    double logged_s = 0.0;
    std::size_t since = 0;  ///< how often it has come since then
  };
  std::map<std::string, Known> known_;
};

}  // namespace slipnav
