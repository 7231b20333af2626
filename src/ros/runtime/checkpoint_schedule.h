#pragma once
/// When and with what content the filter's state is written to a checkpoint.

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <optional>
#include <vector>

#include "core/ordering/continuous_time.h"
#include "ros/runtime/checkpoint_writer.h"
#include "slipnav/core/ekf/engine/filter_engine.h"

namespace slipnav {

/// Does nothing without a file.
class CheckpointSchedule {
 public:
  explicit CheckpointSchedule(const CheckpointParams& params);

  /// An estimate has started.
  void start(const Geodetic& origin, std::uint32_t session);

  /// How the filter's time follows from the clock, which dates checkpoints.
  void setTime(const ContinuousTime& time) { time_ = time; }

  /// Last known parameters of the slip model.
  void setSlipHyperparameters(std::vector<double> values) { slip_hyperparameters_ = std::move(values); }

  /// Writes the filter's state if the interval has passed since the last one.
  void offer(const FilterEngine& filter);

  /// Writes the filter's state and waits for completion. Throws std::runtime_error if it is not possible.
  void save(const FilterEngine& filter);

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const;

 private:
  Checkpoint checkpointOf(const FilterEngine& filter) const;

  CheckpointParams params_;
  std::optional<CheckpointWriter> writer_;
  Geodetic origin_;
  ContinuousTime time_;
  std::uint32_t session_ = 0;
  std::vector<double> slip_hyperparameters_;
  Nanoseconds last_ = 0;
};

}  // namespace slipnav
