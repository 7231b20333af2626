#pragma once
/// What a navigation needs to resume after its process has died: written now and then, read at the next start.
///
/// The file is text: a line with format and version, one line `name values…` each, and a checksum of all that. Numbers
/// have enough digits to restore the same double. It is written next to its place and then moved there; the previous
/// file stays as `file.1`, and is read if the newest is damaged.

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

  /// File that keeps the state, "" for none.
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

/// The lines of a checkpoint followed by their checksum.
std::string withChecksum(const std::string& body);

/// Throws std::invalid_argument with one line that says what is wrong: another format or version, damaged, incomplete,
/// or an impossible state.
Checkpoint parseCheckpoint(const std::string& text);

/// Writes `file`, keeping the previous one as `file.1`. Throws std::runtime_error that names the file.
void saveCheckpoint(const std::string& file, const Checkpoint& checkpoint);

/// Result of reading a checkpoint.
struct LoadedCheckpoint {
  std::optional<Checkpoint> checkpoint;  ///< the newest valid one
  std::vector<std::string> refused;      ///< what was wrong with invalid files, one line each
};

/// Reads `file`, or `file.1` if that is missing or damaged. Never throws.
LoadedCheckpoint loadCheckpoint(const std::string& file);

/// Removes both files, if there are any.
void deleteCheckpoint(const std::string& file);

/// The state to resume from at `now`, a stamp after that of the checkpoint. The vehicle was not tracked meanwhile. It
/// is assumed to be where it was, and its variances grow by its possible motion in those t seconds (1σ on each axis):
///   position   speed_mps · t
///   velocity   speed_mps, and the velocity is assumed to be zero
///   heading    turn_rate_deg_per_s · t, at most max_turn_deg
///   tilt       tilt_deg_per_s · t, likewise
///   slip       as unknown as at any start: correlations with all of these are dropped
/// Throws std::invalid_argument if the checkpoint is older than max_age_s, or newer than `now`.
InitialState resumeFrom(const Checkpoint& checkpoint, Nanoseconds now, const ErrorVector& prior_variance,
                        const CheckpointParams& params);

}  // namespace slipnav
