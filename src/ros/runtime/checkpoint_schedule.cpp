#include "ros/runtime/checkpoint_schedule.h"

#include <stdexcept>

namespace slipnav {

CheckpointSchedule::CheckpointSchedule(const CheckpointParams& params) : params_(params) {
  if (params.enabled()) {
    writer_.emplace(params.place());
  }
}

void CheckpointSchedule::start(const Geodetic& origin, std::uint32_t session) {
  origin_ = origin;
  session_ = session;
  last_ = 0;
}

Checkpoint CheckpointSchedule::checkpointOf(const FilterEngine& filter) const {
  Checkpoint checkpoint;
  checkpoint.state = filter.snapshot();
  checkpoint.state.origin = origin_;
  checkpoint.state.nav.stamp = time_.toClock(checkpoint.state.nav.stamp);
  checkpoint.session = session_;
  checkpoint.slip_hyperparameters = slip_hyperparameters_;
  return checkpoint;
}

void CheckpointSchedule::offer(const FilterEngine& filter) {
  const Nanoseconds now = filter.state().stamp;
  if (writer_ && toSeconds(now - last_) >= params_.interval_s) {
    last_ = now;
    writer_->write(checkpointOf(filter));
  }
}

void CheckpointSchedule::save(const FilterEngine& filter) {
  if (!writer_) {
    throw std::runtime_error("checkpoint.file is not set");
  }
  if (!filter.isInitialized()) {
    throw std::runtime_error("there is no estimate yet");
  }
  writer_->write(checkpointOf(filter));
  writer_->flush();
  const std::string problem = writer_->status().problem;
  if (!problem.empty()) {
    throw std::runtime_error(problem);
  }
}

void CheckpointSchedule::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  if (!writer_) {
    status.add("checkpoints", "off");
    return;
  }
  const CheckpointWriter::Status written = writer_->status();
  status.add("checkpoints", params_.place());
  status.add("checkpoints written", written.written);
  status.add("checkpoints failed", written.failed);
  if (!written.problem.empty()) {
    status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, written.problem);
  }
}

}  // namespace slipnav
