#include "ros/bag/bag_evaluation.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/navigation/sample_merger.h"
#include "evaluation/offline_run.h"
#include "evaluation/truth_lag.h"
#include "io/rtklib_pos.h"
#include "ros/messages/conversions.h"
#include "ros/runtime/child_process.h"

namespace slipnav {
namespace {

/// Processor and wall time since construction.
class Stopwatch {
 public:
  double cpu() const { return static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC; }
  double wall() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(); }

 private:
  std::clock_t cpu_ = std::clock();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

/// The rows of an RTKLIB file that are solutions; the others are counted.
void addTruthFrom(const std::string& path, const BagReader& reader, OfflineRun& run, BagEvaluation& evaluation) {
  const Nanoseconds begin = reader.begin();
  for (const RtklibSolution& solution : readRtklibPos(path)) {
    if (solution.solved()) {
      GnssFix fix = solution.fix;
      fix.stamp += fromSeconds(reader.config().truth.stamp_offset_s);
      run.addTruthFix(fix);
    } else {
      Alarm& rows = evaluation.problems[path + " has rows " + solution.flaw + ": skipped"];
      rows.first = rows.last = begin;
      ++rows.count;
    }
  }
}

void noteFindings(BagEvaluation& evaluation) {
  evaluation.report.metrics.problems = evaluation.problems;
  evaluation.report.metrics.alarms = evaluation.alarms;
}

/// Keeps the truth until it is known how the clock was set back.
class TruthInContinuousTime {
 public:
  void add(const GnssFix& fix) {
    count_.add(fix.stamp);
    fixes_.emplace_back(count_.all(), fix);
  }
  void add(const TruthSample& pose) {
    count_.add(pose.stamp);
    poses_.emplace_back(count_.all(), pose);
  }
  void giveTo(OfflineRun& run, const SampleMerger& merger) {
    for (auto& [steps, fix] : fixes_) {
      fix.stamp += merger.offsetAfter(steps);
      run.addTruthFix(fix);
    }
    for (auto& [steps, pose] : poses_) {
      pose.stamp += merger.offsetAfter(steps);
      run.addTruthPose(pose);
    }
  }

 private:
  StepCount count_;
  std::vector<std::pair<std::size_t, GnssFix>> fixes_;
  std::vector<std::pair<std::size_t, TruthSample>> poses_;
};

/// Notes problems with its stamp.
void push(const Sample& sample, SampleMerger& merger, HealthMonitor& health) {
  const std::uint64_t left_out = merger.leftOut();
  const std::uint64_t overtaken = merger.overtaken();
  const std::size_t steps = merger.time().steps().size();
  merger.push(sample);
  if (merger.leftOut() > left_out) {
    health.note("wrong stamp", merger.newestImuStamp());
  }
  if (merger.overtaken() > overtaken) {
    health.note("IMU samples out of order", merger.newestImuStamp());
  }
  if (merger.time().steps().size() > steps) {
    health.noteSetBack(*merger.time().newestStep_s(), merger.newestImuTime());
  }
}

void noteTruthLeftOut(BagEvaluation& evaluation) {
  if (evaluation.report.metrics.truth_left_out > 0) {
    const Nanoseconds begin = evaluation.begin;
    evaluation.problems["truth rows far off their neighbors: rejected"] = {
        begin, begin, static_cast<std::uint64_t>(evaluation.report.metrics.truth_left_out)};
  }
}

/// The estimate, twice a second.
PlanarTrack planarTrack(const EstimateTrack& estimates) {
  PlanarTrack track;
  for (const EstimateSample& estimate : estimates) {
    if (track.empty() || estimate.stamp - track.back().stamp >= kSecond / 2) {
      track.push_back({estimate.stamp, estimate.position_enu_m.x(), estimate.position_enu_m.y(), 0.0});
    }
  }
  return track;
}

void noteTruthLag(BagEvaluation& evaluation) {
  if (const std::optional<TruthLag> lag = truthLag(planarTrack(evaluation.report.estimates), evaluation.report.truth)) {
    evaluation.problems["truth is " + describe(*lag)] = {evaluation.begin, evaluation.begin, 1};
  }
}

/// Feeds a recording to a run in the order of the stamps.
void feed(const BagReader& reader, bool with_truth, OfflineRun& run, BagEvaluation& evaluation) {
  HealthMonitor health(reader.config().navigation().filter);  // of what does not reach the pipeline
  const Config& config = reader.config();
  SampleMerger merger(config.filter.max_wait_s, config.gnss.always() ? kFixJump : JumpFilter<PositionFix>::kJump);
  TruthInContinuousTime truth;
  const SampleMerger::Sink pass = [&run](const Sample& sample) {
    std::visit([&run](const auto& s) { run.push(s); }, sample);
  };
  const auto take = [&merger, &pass, &health](const Sample& sample) {
    push(sample, merger, health);
    merger.advance(pass);
  };
  BagSink sink;
  sink.imu = take;
  sink.wheels = take;
  sink.fix = [&take](const GnssFix& fix) { take(toPositionFix(fix)); };
  sink.velocity = take;
  sink.truth_start = [&run](const NavigationState& state, bool has_attitude) { run.setTruth(state, has_attitude); };
  sink.truth_fix = [&truth](const GnssFix& fix) { truth.add(fix); };
  sink.truth_pose = [&truth](const TruthSample& pose) { truth.add(pose); };
  HealthMonitor problems(reader.config().navigation().filter);
  sink.problem = [&problems](const std::string& problem, Nanoseconds recorded) { problems.note(problem, recorded); };
  reader.read(sink);
  merger.flush(pass);
  if (with_truth) {
    truth.giveTo(run, merger);
  }
  evaluation.alarms = run.pipeline().health().alarms();
  evaluation.alarms.insert(health.alarms().begin(), health.alarms().end());
  evaluation.problems.insert(problems.alarms().begin(), problems.alarms().end());
  evaluation.alarms.insert(evaluation.problems.begin(), evaluation.problems.end());
}

/// "; most frequent problem", or "".
std::string mostFrequent(const Alarms& problems) {
  const auto most = std::max_element(problems.begin(), problems.end(),
                                     [](const auto& a, const auto& b) { return a.second.count < b.second.count; });
  return most == problems.end() ? "" : "; " + most->first;
}

/// The report, or NoStart with the problems.
void finish(const OfflineRun& run, const TruthAlignment& alignment, BagEvaluation& evaluation) {
  if (!run.hasEstimates()) {
    const std::string failure = run.failure() + mostFrequent(evaluation.problems);
    evaluation.report.metrics.verdict = "no start: " + failure;
    noteFindings(evaluation);
    throw NoStart(failure, std::move(evaluation));
  }
  evaluation.report = run.finish(alignment);
  noteTruthLeftOut(evaluation);
  noteTruthLag(evaluation);
  noteFindings(evaluation);
}

void plot(std::vector<std::string> command) {
  command.insert(command.begin(), packageExecutable("plot_report.py"));
  ChildProcess plotter(command);
  if (plotter.wait() != 0) {
    throw std::runtime_error("the plots could not be made");
  }
}

}  // namespace

BagEvaluation evaluateBag(const std::string& path, const Config& config, const std::string& truth,
                          const BagRange& range) {
  return evaluateBag(std::vector<std::string>{path}, config, truth, range);
}

BagEvaluation evaluateBag(const std::vector<std::string>& paths, const Config& config, const std::string& truth,
                          const BagRange& range, bool smooth) {
  const Stopwatch stopwatch;
  const bool truth_from_file = isRtklibFile(truth);
  const BagReader reader(paths, config, truth_from_file ? "" : truth, range);
  BagEvaluation evaluation;
  OfflineRun run(reader.config(), true);
  if (smooth) {
    run.smoothAfterwards();
  }
  run.onOutput([&evaluation, &reader](const Output& output) {
    nav_msgs::Odometry message;
    fill(output, reader.config().frames, message);
    evaluation.odometry.add(std::move(message));
  });
  if (truth_from_file) {
    addTruthFrom(truth, reader, run, evaluation);
  }
  feed(reader, !truth_from_file, run, evaluation);
  evaluation.begin = reader.begin();
  finish(run, config.truth.alignment(truth_from_file || reader.truthIsGeodetic()), evaluation);
  evaluation.report.metrics.cpu_s = stopwatch.cpu();
  evaluation.report.metrics.realtime_factor = reader.duration() / stopwatch.wall();
  return evaluation;
}

RunReport withEstimates(const RunReport& report, const EstimateTrack& estimates, double wall_s) {
  MetricsInput input;
  input.estimates = estimates;
  input.truth = report.truth;
  input.no_zupt_error_pct = report.metrics.no_zupt_error_pct;
  input.counters.imu_samples = report.metrics.imu_samples;
  input.counters.wheel_samples = report.metrics.wheel_samples;
  input.counters.rejected_samples = report.metrics.rejected_samples;
  input.truth_left_out = report.metrics.truth_left_out;
  input.largest_nis = largestNis(report.diagnostics.filter);
  input.stops = {report.metrics.stops_seen, report.metrics.stops_used};
  RunReport result;
  result.estimates = estimates;
  result.truth = report.truth;
  result.forecasts = report.forecasts;
  result.diagnostics = report.diagnostics;
  result.metrics = computeMetrics(input);
  result.metrics.wheel_only_error_pct = report.metrics.wheel_only_error_pct;
  result.metrics.threshold_m = report.metrics.threshold_m;
  result.metrics.problems = report.metrics.problems;
  result.metrics.alarms = report.metrics.alarms;
  result.metrics.realtime_factor = result.metrics.duration_s / wall_s;
  return result;
}

void plotReport(const std::string& directory) { plot({directory}); }

void plotStop(const std::string& directory, int number) { plot({directory, "--figure", std::to_string(number)}); }

std::string runName(const std::string& path) {
  const std::string file = path.substr(path.find_last_of('/') + 1);
  return file.substr(0, file.rfind(".bag"));
}

}  // namespace slipnav
