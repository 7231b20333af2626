#pragma once
/// A recording through the pipeline as fast as possible, and the result.

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "config/config.h"
#include "evaluation/report.h"
#include "ros/bag/bag_reader.h"
#include "ros/bag/odometry_log.h"

namespace slipnav {

/// The report of a recording, and the problems with its messages.
struct BagEvaluation {
  RunReport report;
  OdometryLog odometry;   ///< what the nodelets publish for this recording
  Alarms problems;        ///< unusable messages: what was wrong
  Alarms alarms;          ///< the same, and everything the monitoring has reported
  Nanoseconds begin = 0;  ///< of the recording
};

/// No start could be found. Contains the problems until then.
class NoStart : public std::runtime_error {
 public:
  NoStart(const std::string& what, BagEvaluation evaluation)
      : std::runtime_error(what), evaluation_(std::move(evaluation)) {}
  /// Without estimates; the metrics contain problems and alarms.
  const BagEvaluation& evaluation() const { return evaluation_; }

 private:
  BagEvaluation evaluation_;
};

/// @param range the part of the recording to use
/// @param truth topic or RTKLIB file (.pos) of the truth; "" for what the recording has, see BagReader
/// Throws std::invalid_argument for an unusable recording, NoStart if no start could be found.
BagEvaluation evaluateBag(const std::string& path, const Config& config, const std::string& truth,
                          const BagRange& range);
/// @param paths the parts of one recording; @param smooth also run it backwards
BagEvaluation evaluateBag(const std::vector<std::string>& paths, const Config& config, const std::string& truth,
                          const BagRange& range, bool smooth = false);

/// The report with other estimates of the same drive in place of its own; errors, stops and times become theirs.
/// @param wall_s time it took to make them [s]
RunReport withEstimates(const RunReport& report, const EstimateTrack& estimates, double wall_s);

/// Draws the plots of a report in `directory`. Throws std::runtime_error if that fails.
void plotReport(const std::string& directory);

/// Draws the paper's figure of one of its stops, counted from 1, as stop_NUMBER.png. Throws likewise.
void plotStop(const std::string& directory, int number);

/// Name of a run in tables: the file without folder and ending.
std::string runName(const std::string& path);

}  // namespace slipnav
