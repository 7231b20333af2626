#pragma once
/// Where the runs of a tuning take place, and how those elsewhere are asked for.

#include <Eigen/Core>
#include <condition_variable>
#include <functional>
#include <iosfwd>
#include <map>
#include <mutex>
#include <string>

#include "evaluation/parallel_for.h"
#include "tuning/drive_likelihood.h"

namespace slipnav {

/// One drive with the knobs moved by `position`.
struct TuningRun {
  std::size_t drive = 0;      ///< its number
  std::size_t stretches = 0;  ///< how many of them to run
  Eigen::VectorXd position;   ///< one entry for each knob
};

/// What runs the drives of a tuning.
struct TuningRuns {
  std::size_t slots = coreCount();  ///< runs at a time
  /// Called from several threads; empty: they run in this process.
  std::function<DriveLikelihood(const TuningRun&)> elsewhere;
};

/// "DRIVE STRETCHES POSITION...", exact to the last bit.
std::string runText(const TuningRun& run);
/// Throws std::invalid_argument.
TuningRun runFromText(const std::string& text);

/// Numbers in one line, exact to the last bit.
std::string likelihoodText(const DriveLikelihood& likelihood);
/// Throws std::invalid_argument.
DriveLikelihood likelihoodFromText(const std::string& text);

/// Asks for runs by lines of text, and reads the answers, in any order:
///
///     run NUMBER DRIVE STRETCHES POSITION...        out
///     done NUMBER LIKELIHOOD...                     in
///     failed NUMBER REASON                          in
class RunExchange {
 public:
  RunExchange(std::istream& answers, std::ostream& requests) : answers_(answers), requests_(requests) {}

  /// From any thread. Throws std::runtime_error with the reason of a failure, or if answers have ended.
  DriveLikelihood ask(const TuningRun& run);

 private:
  void readOne(std::unique_lock<std::mutex>& lock);

  std::istream& answers_;
  std::ostream& requests_;
  std::mutex mutex_;
  std::condition_variable read_;
  bool reading_ = false;  ///< one of the waiting threads
  bool ended_ = false;
  std::size_t next_ = 0;
  std::map<std::size_t, std::string> pending_;  ///< answers not yet taken, from "done" or "failed" on
};

}  // namespace slipnav
