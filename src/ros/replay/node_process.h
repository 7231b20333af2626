#pragma once
/// The process of another node of this machine.

#include <sys/types.h>

#include <cstdint>
#include <string>

namespace slipnav {

/// @param node full name; @return 0 when it is not there
pid_t pidOf(const std::string& node);

/// What a process has used so far.
struct ProcessUsage {
  double cpu_s = 0.0;
  double memory_mb = 0.0;  ///< resident
  int threads = 0;
};

/// Throws std::runtime_error when there is no such process.
ProcessUsage usageOf(pid_t process);

}  // namespace slipnav
