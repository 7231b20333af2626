#include "inspection/position_check.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "evaluation/truth_gate.h"
#include "evaluation/truth_lag.h"
#include "inspection/stream_check.h"
#include "slipnav/core/earth/planet.h"
#include "slipnav/core/ekf/models/gnss_fix.h"

namespace slipnav {
namespace {

/// Quality is mixed if the worst 1σ is this many times the best.
constexpr double kMixed = 5.0;
constexpr double kPoor_m = 1.0;
/// Slopes that no rover drives on average.
constexpr double kSteep = 0.3;
constexpr double kPiece_m = 10.0;
constexpr double kChord_m = 1.0;
/// Share of the time of a piece that wheels must cover, and of its distance that may be backwards.
constexpr double kComplete = 0.9;
constexpr double kReverseShare = 0.01;
constexpr std::size_t kLeastPieces = 3;
/// Radii are not further off than this; beyond, the unit is wrong.
constexpr double kScaleTolerance = 0.05;
constexpr double kManyJumps = 0.1;

double horizontalSigma(const RawFixSample& sample) {
  return std::sqrt(std::max(0.5 * (sample.fix.covariance_ned_m2(0, 0) + sample.fix.covariance_ned_m2(1, 1)), 0.0));
}

std::size_t countIf(const FixRecord& record, bool (*condition)(const RawFixSample&)) {
  return static_cast<std::size_t>(std::count_if(record.samples.begin(), record.samples.end(), condition));
}

void checkSolutions(const FixRecord& record, Findings& findings) {
  const std::size_t without = countIf(record, [](const RawFixSample& sample) { return !sample.has_fix; });
  const std::size_t nowhere =
      countIf(record, [](const RawFixSample& sample) { return sample.has_fix && sample.is_nowhere; });
  const std::size_t unknown =
      countIf(record, [](const RawFixSample& sample) { return sample.is_usable && !sample.has_covariance; });
  const std::string of = " of " + counted(record.samples.size(), "message");
  if (without > 0) {
    findings.push_back({without == record.samples.size() ? Severity::kDoubtful : Severity::kRemark, record.topic,
                        std::to_string(without) + of + " have no fix", "they are rejected; start under open sky"});
  }
  if (nowhere > 0) {
    findings.push_back({Severity::kDoubtful, record.topic,
                        std::to_string(nowhere) + of + " are at latitude 0, longitude 0 with a good status",
                        "they are rejected: the receiver has no fix yet; its driver should report that"});
  }
  if (unknown > 0) {
    findings.push_back(
        {Severity::kDoubtful, record.topic, std::to_string(unknown) + of + " have no covariance",
         "5 m horizontally and 10 m vertically are assumed (1σ); the driver should pass on the receiver's values"});
  }
}

void checkQuality(const FixRecord& record, Findings& findings) {
  for (const auto& [flaw, rows] : record.left_out) {
    findings.push_back({Severity::kRemark, record.topic, counted(rows, "row") + " " + flaw, "nothing: skipped"});
  }
  std::vector<double> sigmas;
  for (const RawFixSample& sample : record.samples) {
    if (sample.is_usable) {
      sigmas.push_back(horizontalSigma(sample));
    }
  }
  if (sigmas.empty()) {
    findings.push_back({Severity::kDoubtful, record.topic, "not a single usable fix",
                        "initialization.source: motion starts without satellites"});
    return;
  }
  const double best = percentile(sigmas, 5.0);
  const double worst = *std::max_element(sigmas.begin(), sigmas.end());
  const std::string span = decimal(best, 2) + " to " + decimal(worst, 2) + " m (1σ, horizontal)";
  if (worst > kMixed * best && worst > kPoor_m) {
    const auto poor =
        std::count_if(sigmas.begin(), sigmas.end(), [best](double sigma) { return sigma > kMixed * best; });
    findings.push_back(
        {Severity::kDoubtful, record.topic,
         "fixes of mixed quality, " + span + ": " + std::to_string(poor) + " of them far worse than the others",
         "each is weighted by its covariance; wait for the receiver to settle before driving"});
  } else if (best > kPoor_m) {
    findings.push_back({Severity::kRemark, record.topic, "fixes are good to " + span,
                        "the start has that uncertainty, and so does truth taken from them"});
  }
}

void checkHeight(const std::string& topic, const TruthTrack& positions, Findings& findings) {
  if (positions.samples().size() < 2) {
    return;
  }
  std::vector<double> heights;
  double largest_m = 0.0;
  for (const TruthSample& sample : positions.samples()) {
    heights.push_back(sample.position_enu_m.z());
    largest_m = std::max(largest_m, sample.position_enu_m.head<2>().norm());
  }
  const double span_m = percentile(heights, 95.0) - percentile(heights, 5.0);
  if (span_m > 5.0 && span_m > kSteep * largest_m) {
    findings.push_back(
        {Severity::kDoubtful, topic,
         "height wanders by " + decimal(span_m, 0) + " m within " + decimal(largest_m, 0) + " m of the start",
         "do not judge heights by it: use truth: {align: heading} and the horizontal figures"});
  }
}

/// Distance by the wheels between two times [unit of the track]; negative if the vehicle reversed or rows are missing.
double wayForward(const WheelTrack& wheels, double from_s, double to_s) {
  double way = 0.0;
  double covered_s = 0.0;
  double reverse = 0.0;
  const auto begin = std::upper_bound(wheels.rows.begin(), wheels.rows.end(), from_s,
                                      [](double t, const WheelRow& row) { return t < row.time_s; });
  for (auto row = begin; row != wheels.rows.end() && row->time_s <= to_s; ++row) {
    way += row->speed * row->interval_s;
    reverse += row->speed < 0.0 ? -row->speed * row->interval_s : 0.0;
    covered_s += row->interval_s;
  }
  const bool complete = covered_s > kComplete * (to_s - from_s);
  return complete && reverse < kReverseShare * std::abs(way) ? way : -1.0;
}

}  // namespace

TruthTrack positionsOf(const FixRecord& record, Nanoseconds origin) {
  const std::vector<double> times_s = continuousTimes(timesOf(record), origin);
  std::vector<GnssFix> fixes;
  for (std::size_t i = 0; i < record.samples.size(); ++i) {
    if (record.samples[i].is_usable) {
      fixes.push_back(record.samples[i].fix);
      fixes.back().stamp = fromSeconds(times_s[i]);
    }
  }
  if (fixes.empty()) {
    return {};
  }
  return TruthTrack::fromFixes(fixes, LocalFrame(Planet::byName("earth"), toPositionFix(fixes.back()).position));
}

TruthTrack positionsOf(const PoseRecord& record, Nanoseconds origin) {
  const std::vector<double> times_s = continuousTimes(timesOf(record), origin);
  std::vector<TruthSample> samples;
  for (std::size_t i = 0; i < record.samples.size(); ++i) {
    if (record.samples[i].position_m.allFinite()) {
      samples.push_back({fromSeconds(times_s[i]), record.samples[i].position_m});
    }
  }
  return TruthTrack(std::move(samples));
}

void checkFixes(const FixRecord& record, const TruthTrack& positions, Findings& findings) {
  checkSolutions(record, findings);
  checkQuality(record, findings);
  checkHeight(record.topic, positions, findings);
}

void checkJumps(const std::string& topic, const TruthTrack& positions, Findings& findings) {
  const std::size_t rows = positions.samples().size();
  const std::size_t jumps = rows - withoutJumps(positions).samples().size();
  if (jumps > 0) {
    const bool many = static_cast<double>(jumps) > kManyJumps * static_cast<double>(rows);
    findings.push_back({Severity::kDoubtful, topic,
                        counted(jumps, "outlier") + " among " + counted(rows, "position") +
                            ": more than a meter from those around " + (jumps == 1 ? "it" : "them"),
                        many ? "check the receiver: a tenth or more are not outliers"
                             : "rejected as truth, of little weight at the start"});
  }
}

void checkTimeInCommon(const std::string& topic, const TruthTrack& positions, double imu_begin_s, double imu_end_s,
                       Findings& findings) {
  if (positions.empty()) {
    return;
  }
  const double begin_s = toSeconds(positions.samples().front().stamp);
  const double end_s = toSeconds(positions.samples().back().stamp);
  if (end_s < imu_begin_s || begin_s > imu_end_s) {
    findings.push_back({Severity::kUnusable, topic,
                        "has no time in common with the IMU: it begins " + decimal(begin_s - imu_begin_s, 1) +
                            " s after it and ends " + decimal(end_s - imu_end_s, 1) + " s after it",
                        "use the truth of this drive, and check its time scale (GPS, UTC, local)"});
    return;
  }
  const double common_s = std::min(end_s, imu_end_s) - std::max(begin_s, imu_begin_s);
  if (common_s < 0.5 * (imu_end_s - imu_begin_s)) {
    findings.push_back(
        {Severity::kRemark, topic,
         "covers " + decimal(common_s, 0) + " s of the " + decimal(imu_end_s - imu_begin_s, 0) + " s of the drive",
         "errors are evaluated there only"});
  }
}

PlanarTrack deadReckoning(const ImuTrack& imu, const WheelTrack& wheels, const Vector3& up, const Vector3& bias,
                          double wheels_ahead_s) {
  PlanarTrack track;
  PlanarSample pose;
  for (const WheelRow& row : wheels.in_meters ? wheels.rows : std::vector<WheelRow>{}) {
    const double middle_s = row.time_s - wheels_ahead_s;
    const double from_s = middle_s - 0.5 * row.interval_s;
    const double to_s = middle_s + 0.5 * row.interval_s;
    pose.stamp = fromSeconds(to_s);
    if (imu.firstAfter(to_s) > imu.firstAfter(from_s)) {  // clockwise, and up is the other way
      pose.heading_rad -= row.interval_s * up.dot(imu.meanRate(from_s, to_s) - bias);
    }
    pose.east_m += row.interval_s * row.speed * std::sin(pose.heading_rad);
    pose.north_m += row.interval_s * row.speed * std::cos(pose.heading_rad);
    track.push_back(pose);
  }
  return track;
}

void checkClockByTrack(const std::string& topic, const TruthTrack& positions, const PlanarTrack& drive,
                       Findings& findings) {
  if (const std::optional<TruthLag> lag = truthLag(drive, positions)) {
    findings.push_back({Severity::kUnusable, topic, describe(*lag),
                        "synchronize the clocks (chrony); gps/fix: initialization.fix_stamp_offset_s; truth: "
                        "truth.stamp_offset_s"});
  }
}

WheelScale wheelScale(const TruthTrack& positions, const WheelTrack& wheels) {
  WheelScale scale;
  const TruthTrack track = withoutJumps(positions);
  if (track.empty()) {
    return scale;
  }
  std::vector<double> ratios;
  TruthSample begin = track.samples().front();
  TruthSample before = begin;
  double along_m = 0.0;
  for (const TruthSample& sample : track.samples()) {
    const double chord_m = (sample.position_enu_m - before.position_enu_m).head<2>().norm();
    if (chord_m < kChord_m) {
      continue;  // shorter ones are noise
    }
    along_m += chord_m;
    before = sample;
    if (along_m < kPiece_m) {
      continue;
    }
    const double way = wayForward(wheels, toSeconds(begin.stamp), toSeconds(sample.stamp));
    if (way > 0.0) {
      ratios.push_back(along_m / way);
      scale.distance_m += along_m;
    }
    begin = sample;
    along_m = 0.0;
  }
  if (ratios.size() >= kLeastPieces) {
    scale.known = true;
    scale.value = median(ratios);
    scale.std = standardDeviation(ratios) / std::sqrt(static_cast<double>(ratios.size()));
  }
  return scale;
}

void checkWheelScale(const std::string& topic, const WheelScale& scale, const WheelTrack& wheels, Findings& findings) {
  if (!scale.known) {
    return;
  }
  const std::string measured = decimal(scale.value, 4) + " ± " + decimal(scale.std, 4);
  const std::string from = " over " + decimal(scale.distance_m, 0) + " m against " + topic;
  if (!wheels.in_meters) {
    findings.push_back({Severity::kRemark, wheels.topic, "the wheel radius is " + measured + " m," + from,
                        "measure it, or let ./run calibrate find it"});
    return;
  }
  const bool wrong = std::abs(scale.value - 1.0) > kScaleTolerance + 3.0 * scale.std;
  findings.push_back({wrong ? Severity::kDoubtful : Severity::kRemark, wheels.topic,
                      "ground over wheels is " + measured + from,
                      wrong ? "check wheels[].radius_m, or the unit of the odometry" : "nothing"});
}

}  // namespace slipnav
