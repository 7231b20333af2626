#pragma once
/// The process of another node on this machine.

#include <sys/types.h>

#include <cstdint>
#include <string>

namespace slipnav {

/// @param node full name; @return 0 if it does not exist
pid_t pidOf(const std::string& node);

/// Resources a process has used so far.
struct ProcessUsage {
  double cpu_s = 0.0;
  double memory_mb = 0.0;  ///< resident
  int threads = 0;
};

/// Throws std::runtime_error if there is no such process.
ProcessUsage usageOf(pid_t process);

}  // namespace slipnav
