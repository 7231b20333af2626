#pragma once
/// Output files that appear complete or not at all.

#include <fstream>
#include <ostream>
#include <string>

namespace slipnav {

/// Writes `path + ".part"` and moves it to `path` on commit(). Destroyed without commit(), it leaves `path` unchanged.
class AtomicFile {
 public:
  /// Throws std::runtime_error naming the path if the file cannot be opened.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Accepts text in the classic locale.
  std::ostream& stream() { return file_; }
  /// Throws std::runtime_error naming the path if something could not be written.
  void commit();

 private:
  std::string path_;
  std::string part_path_;
  std::ofstream file_;
  bool committed_ = false;
};

/// Creates a directory and its parents. Throws std::runtime_error naming the path if that is not possible.
void createDirectories(const std::string& path);

}  // namespace slipnav
