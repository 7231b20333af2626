#pragma once
/// What a navigation needs to go on after its process has died: written now and then, read at the next start.
///
/// The file is text: a line with format and version, one line `name values…` each, and a checksum of all that. Numbers
/// have the digits that give back the same double. It is written beside its place and then moved there; the file before
/// stays as `file.1`, and is what is read when the newest is damaged.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav {

/// Block `checkpoint`.
struct CheckpointParams {
  std::string file;
  std::string launch_file;
  std::string stop_file;
  double interval_s = 2.0;
  double max_age_s = 600.0;
  double speed_mps = 0.8;
  double turn_rate_deg_per_s = 5.0;
  double tilt_deg_per_s = 2.0;
  double max_turn_deg = 20.0;
  void visit(ParameterVisitor& v);

  /// Where the state is kept, "" for nowhere.
  const std::string& place() const { return file.empty() ? launch_file : file; }
  bool enabled() const { return !place().empty(); }
};

/// The whole state of filter and slip model at one stamp.
struct Checkpoint {
  InitialState state;
  std::uint32_t session = 0;                 ///< restarts of the clock before it
  std::vector<double> slip_hyperparameters;  ///< of the slip model, in its own order; may be empty
};

/// The text of a checkpoint.
std::string formatCheckpoint(const Checkpoint& checkpoint);

/// The lines of a checkpoint with the checksum that belongs to them.
std::string withChecksum(const std::string& body);

/// Throws std::invalid_argument of one line that says what is wrong: another format or version, damaged, incomplete, or
/// numbers that cannot be a state.
Checkpoint parseCheckpoint(const std::string& text);

/// Writes `file`, keeping the one before as `file.1`. Throws std::runtime_error that names the file.
void saveCheckpoint(const std::string& file, const Checkpoint& checkpoint);

/// What was found at the place of a checkpoint.
struct LoadedCheckpoint {
  std::optional<Checkpoint> checkpoint;  ///< the newest that is sound
  std::vector<std::string> refused;      ///< what was wrong with the files that were not, one line each
};

/// Reads `file`, or `file.1` when that one is missing or damaged. Never throws.
LoadedCheckpoint loadCheckpoint(const std::string& file);

/// Removes both files, where there are any.
void deleteCheckpoint(const std::string& file);

/// The state to go on from at `now`, a stamp after that of the checkpoint. Nobody has watched the vehicle meanwhile. It
/// is taken to be where it was, and its variances grow by what it may have done in those t seconds (1σ on each axis):
///   position   speed_mps · t
///   velocity   speed_mps, and the velocity is taken to be zero
///   heading    turn_rate_deg_per_s · t, at most max_turn_deg
///   tilt       tilt_deg_per_s · t, likewise
///   slip       as unknown as at any start: correlations with all of these are forgotten
/// Throws std::invalid_argument when the checkpoint is older than max_age_s, or newer than `now`.
InitialState resumeFrom(const Checkpoint& checkpoint, Nanoseconds now, const ErrorVector& prior_variance,
                        const CheckpointParams& params);

}  // namespace slipnav
