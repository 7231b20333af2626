#pragma once
/// What every fuzz target defines: one input, as libFuzzer hands it over. It must not crash, whatever the bytes are.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace slipnav::fuzz {

inline std::string toText(const std::uint8_t* data, std::size_t size) { return {data, data + size}; }

/// A file with the input in memory-backed storage, for readers that take a path.
class InputFile {
 public:
  InputFile(const std::uint8_t* data, std::size_t size) : path_("/dev/shm/slipnav_fuzz_" + std::to_string(getpid())) {
    std::ofstream file(path_, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  ~InputFile() { std::remove(path_.c_str()); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace slipnav::fuzz
