#pragma once
/// The one chance to go on where an estimate ended: from the checkpoint of the program's predecessor, or from what the
/// filter handed over last.

#include <optional>
#include <string>
#include <vector>

#include "core/navigation/checkpoint.h"
#include "slipnav/core/ekf/engine/filter_params.h"

namespace slipnav {

/// Holds the checkpoint until it is used or of no use any more.
class Resumption {
 public:
  /// Reads the checkpoint, if the parameters name a file.
  Resumption(const Planet& planet, const CheckpointParams& params, const FilterSetup& setup);

  /// Files that were there and could not be used, one line each.
  const std::vector<std::string>& refused() const { return refused_; }

  /// Holds a newer state instead.
  void offer(const InitialState& state) { checkpoint_ = Checkpoint{state, 0, {}}; }

  bool isPossible() const { return checkpoint_.has_value(); }

  /// The state to go on from at `now` (see resumeFrom()); it is given once. Throws std::invalid_argument when the
  /// checkpoint is of another time; then there is none any more.
  InitialState resume(Nanoseconds now);

  /// How long the vehicle was unwatched before it went on [s].
  double unwatched() const { return unwatched_s_; }

  /// What is held is not to be used.
  void forget() { checkpoint_.reset(); }

  /// Likewise, and no later start shall find it either.
  void deleteFiles();

 private:
  CheckpointParams params_;
  ErrorVector prior_variance_;
  std::optional<Checkpoint> checkpoint_;
  std::vector<std::string> refused_;
  double unwatched_s_ = 0.0;
};

}  // namespace slipnav
