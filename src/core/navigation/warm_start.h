#pragma once
/// Resumes an ended estimate, once: from the checkpoint of the program's predecessor, or from what the
/// filter last handed over.

#include <optional>
#include <string>
#include <vector>

#include "core/navigation/checkpoint.h"
#include "slipnav/core/ekf/engine/filter_params.h"

namespace slipnav {

/// Holds the checkpoint until it is used or no longer usable.
class WarmStart {
 public:
  /// Reads the checkpoint, if the parameters name a file.
  WarmStart(const Planet& planet, const CheckpointParams& params, const FilterSetup& setup);

  /// Files that existed but could not be used, one line each.
  const std::vector<std::string>& refused() const { return refused_; }

  /// Holds a newer state instead.
  void offer(const InitialState& state) { checkpoint_ = Checkpoint{state, 0, {}}; }

  bool isPossible() const { return checkpoint_.has_value(); }

  /// The state to resume from at `now` (see resumeFrom()), returned only once. Throws std::invalid_argument if the
  /// checkpoint is from another time; then it is discarded.
  InitialState resume(Nanoseconds now);

  /// How long the vehicle was not tracked before resuming [s].
  double unwatched() const { return unwatched_s_; }

  /// Discards the held state.
  void forget() { checkpoint_.reset(); }

  /// Likewise, so that no later start finds it either.
  void deleteFiles();

 private:
  CheckpointParams params_;
  ErrorVector prior_variance_;
  std::optional<Checkpoint> checkpoint_;
  std::vector<std::string> refused_;
  double unwatched_s_ = 0.0;
};

}  // namespace slipnav
