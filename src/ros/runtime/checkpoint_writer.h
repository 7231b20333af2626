#pragma once
/// Writes checkpoints in a separate thread, so that no callback waits for a disk.

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/navigation/checkpoint.h"

namespace slipnav {

/// Thread-safe.
class CheckpointWriter {
 public:
  explicit CheckpointWriter(std::string file);
  /// Writes what is still to be written.
  ~CheckpointWriter();
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;

  /// Takes a checkpoint and returns at once. A pending one is replaced.
  void write(Checkpoint checkpoint);

  /// Waits until everything taken is written.
  void flush();

  /// Counts since the start.
  struct Status {
    std::uint64_t written = 0;
    std::uint64_t failed = 0;
    std::string problem;  ///< of the last one, "" if it was written
  };
  Status status() const;

 private:
  void run();
  void save(const Checkpoint& checkpoint, std::unique_lock<std::mutex>& lock);

  std::string file_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Checkpoint> waiting_;
  bool busy_ = false;
  bool ending_ = false;
  Status status_;
  std::thread thread_;  ///< the last member: it uses the others
};

}  // namespace slipnav
