#include "ros/runtime/child_process.h"

#include <dlfcn.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

extern char** environ;

namespace slipnav {
namespace {

constexpr int kUnknownStatus = 127;  // something else has waited for the program

int exitStatus(int wait_status) {
  return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command) : pid_(0) {
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  const int error = posix_spawnp(&pid_, arguments[0], nullptr, nullptr, arguments.data(), environ);
  if (error != 0) {
    throw std::runtime_error(command.front() + ": cannot be started: " + std::strerror(error));
  }
}

ChildProcess::~ChildProcess() {
  if (!poll()) {
    kill(pid_, SIGINT);
    wait();
  }
}

std::optional<int> ChildProcess::poll() noexcept {
  int wait_status = 0;
  if (!status_ && waitpid(pid_, &wait_status, WNOHANG) == pid_) {
    status_ = exitStatus(wait_status);
  }
  return status_;
}

int ChildProcess::wait() noexcept {
  int wait_status = 0;
  while (!status_) {
    if (waitpid(pid_, &wait_status, 0) == pid_) {
      status_ = exitStatus(wait_status);
    } else if (errno != EINTR) {
      status_ = kUnknownStatus;
    }
  }
  return *status_;
}

std::string packageExecutable(const std::string& name) {
  Dl_info library = {};
  if (dladdr(reinterpret_cast<const void*>(&packageExecutable), &library) == 0) {
    throw std::runtime_error("the folder of this package's libraries cannot be determined");
  }
  const std::string path = library.dli_fname;
  return path.substr(0, path.find_last_of('/') + 1) + "slipnav/" + name;
}

}  // namespace slipnav
