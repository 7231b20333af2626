#include "ros/runtime/checkpoint_writer.h"

#include <utility>

namespace slipnav {

CheckpointWriter::CheckpointWriter(std::string file) : file_(std::move(file)), thread_([this] { run(); }) {}

CheckpointWriter::~CheckpointWriter() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void CheckpointWriter::write(Checkpoint checkpoint) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_ = std::move(checkpoint);
  }
  changed_.notify_all();
}

void CheckpointWriter::flush() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return !waiting_ && !busy_; });
}

CheckpointWriter::Status CheckpointWriter::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

void CheckpointWriter::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return waiting_ || ending_; });
    if (!waiting_) {
      return;
    }
    const Checkpoint checkpoint = *std::exchange(waiting_, std::nullopt);
    busy_ = true;
    save(checkpoint, lock);
    busy_ = false;
    changed_.notify_all();
  }
}

void CheckpointWriter::save(const Checkpoint& checkpoint, std::unique_lock<std::mutex>& lock) {
  std::string problem;
  lock.unlock();
  try {
    saveCheckpoint(file_, checkpoint);
  } catch (const std::exception& error) {
    problem = error.what();
  }
  lock.lock();
  ++(problem.empty() ? status_.written : status_.failed);
  status_.problem = problem;
}

}  // namespace slipnav
