#include "core/stopping/stop_latch.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace slipnav {
namespace {

constexpr mode_t kRights = 0644;

[[noreturn]] void fail(const std::string& file) {
  throw std::runtime_error("cannot write " + file + ": " + std::strerror(errno));
}

/// A file that is closed when this object ends.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC, kRights)) {}
  ~Descriptor() {
    if (number_ >= 0) {
      ::close(number_);
    }
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool isOpen() const { return number_ >= 0; }
  bool write(const std::string& text) const {
    return ::write(number_, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  }
  bool flush() const { return ::fsync(number_) == 0; }

 private:
  int number_;
};

}  // namespace

std::string formatStopLatch(const StopLatch& latch) {
  return std::string("slipnav stop 1 emergency_stop ") + (latch.emergency_stop ? "1" : "0") + " override " +
         (latch.overridden ? "1" : "0") + "\n";
}

void saveStopLatch(const std::string& file, const StopLatch& latch) {
  const std::string part = file + ".part";
  {
    const Descriptor output(part, O_WRONLY | O_CREAT | O_TRUNC);
    if (!output.isOpen() || !output.write(formatStopLatch(latch)) || !output.flush()) {
      fail(file);
    }
  }
  if (::rename(part.c_str(), file.c_str()) != 0) {
    fail(file);
  }
  const std::string folder = std::filesystem::path(file).parent_path();
  const Descriptor entries(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
  if (!entries.isOpen() || !entries.flush()) {
    fail(file);
  }
}

LoadedStopLatch loadStopLatch(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error) && !error) {
    return {};
  }
  std::ostringstream content;
  if (std::filesystem::is_regular_file(file, error)) {
    content << std::ifstream(file, std::ios::binary).rdbuf();
  }
  const std::string text = content.str();
  for (const bool emergency_stop : {false, true}) {
    for (const bool overridden : {false, true}) {
      const StopLatch latch{emergency_stop, overridden};
      if (text == formatStopLatch(latch)) {
        return {latch, ""};
      }
    }
  }
  return {{true, false}, file + " cannot be understood, which counts as an emergency stop"};
}

}  // namespace slipnav
