#pragma once
/// Another program, started by an executable of this package.

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace slipnav {

/// The program does not outlive this object.
class ChildProcess {
 public:
  /// @param command the program (looked up in PATH if it has no slash) and its arguments
  /// Throws std::runtime_error that names the program if it cannot be started.
  explicit ChildProcess(const std::vector<std::string>& command);
  /// Interrupts the program if it is still running, and waits for its end.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// The exit status once it has ended (128 + signal if it was killed), nothing while it runs.
  std::optional<int> poll() noexcept;
  /// Waits for the end. @return the exit status as above
  int wait() noexcept;

 private:
  pid_t pid_;
  std::optional<int> status_;
};

/// Path of an executable or script of this package: next to its libraries in lib/slipnav, as catkin lays them out.
std::string packageExecutable(const std::string& name);

}  // namespace slipnav
