#include "core/base/atomic_file.h"

#include <filesystem>
#include <locale>
#include <stdexcept>
#include <system_error>

namespace slipnav {

AtomicFile::AtomicFile(const std::string& path) : path_(path), part_path_(path + ".part") {
  file_.imbue(std::locale::classic());
  file_.open(part_path_, std::ios::out | std::ios::trunc);
  if (!file_) {
    throw std::runtime_error("cannot write " + path_);
  }
}

AtomicFile::~AtomicFile() {
  if (!committed_) {
    file_.close();
    std::error_code ignored;
    std::filesystem::remove(part_path_, ignored);
  }
}

void AtomicFile::commit() {
  file_.close();
  if (file_.fail()) {
    throw std::runtime_error("cannot write " + path_);
  }
  std::error_code error;
  std::filesystem::rename(part_path_, path_, error);
  if (error) {
    throw std::runtime_error("cannot write " + path_ + ": " + error.message());
  }
  committed_ = true;
}

void createDirectories(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path)) {
    throw std::runtime_error("cannot create directory " + path + (error ? ": " + error.message() : ""));
  }
}

}  // namespace slipnav
