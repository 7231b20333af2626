#include "inspection/wheel_track.h"

#include <algorithm>
#include <cmath>

#include "core/base/statistics.h"
#include "core/sensors/wheel_decoder.h"
#include "inspection/stream_check.h"

namespace slipnav {
namespace {

/// No wheel of a rover turns faster.
constexpr double kLargestRate_radps = 200.0;
/// Relative to the usual driving speed; below is at rest.
constexpr double kRestShare = 0.04;
/// Turning in place counts as motion, too: at about this distance from the middle.
constexpr double kTurnArm_m = 0.25;
/// Shorter intervals are merged.
constexpr double kLeast_s = 0.099;
constexpr double kMergeGap_s = 0.01;
/// Longer intervals are gaps.
constexpr double kLongest_s = 2.0;

void addOnce(const std::string& text, std::vector<std::string>& texts) {
  if (!text.empty() && std::find(texts.begin(), texts.end(), text) == texts.end()) {
    texts.push_back(text);
  }
}

std::vector<WheelParams> asParameters(const std::vector<WheelJoint>& wheels) {
  std::vector<WheelParams> parameters;
  parameters.reserve(wheels.size());
  for (const WheelJoint& wheel : wheels) {
    parameters.push_back({wheel.name, 1.0, 0.0, 0.0, 1.0});  // rates as they are
  }
  return parameters;
}

/// Mean over the wheels of one side, or all (kUnknown).
double meanOf(const WheelSample& sample, const std::vector<WheelJoint>& wheels, Side side, bool in_meters) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    if (side == Side::kUnknown || wheels[i].side == side) {
      sum += wheels[i].sign * sample.rate_radps[i] * (in_meters ? wheels[i].radius_m : 1.0);
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

WheelRow rowOf(const WheelSample& sample, double interval_s, const std::vector<WheelJoint>& wheels,
               const WheelTrack& track) {
  WheelRow row;
  row.time_s = toSeconds(sample.stamp) - 0.5 * interval_s;
  row.interval_s = interval_s;
  if (track.has_turn) {
    const double left = meanOf(sample, wheels, Side::kLeft, track.in_meters);
    const double right = meanOf(sample, wheels, Side::kRight, track.in_meters);
    row.speed = 0.5 * (left + right);
    row.turn = right - left;
  } else {
    row.speed = meanOf(sample, wheels, Side::kUnknown, track.in_meters);
  }
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    row.largest = std::max(row.largest, std::abs(sample.rate_radps[i]) * (track.in_meters ? wheels[i].radius_m : 1.0));
  }
  return row;
}

/// Merges rows shorter than kLeast_s: encoder counts over a short interval are coarse.
std::vector<WheelRow> merged(const std::vector<WheelRow>& rows) {
  std::vector<WheelRow> result;
  WheelRow sum;
  double end_s = 0.0;
  const auto close = [&] {
    if (sum.interval_s > 0.0) {
      result.push_back({end_s - 0.5 * sum.interval_s, sum.interval_s, sum.speed / sum.interval_s,
                        sum.turn / sum.interval_s, sum.largest});
    }
    sum = WheelRow();
  };
  for (const WheelRow& row : rows) {
    if (sum.interval_s > 0.0 && row.time_s - 0.5 * row.interval_s > end_s + kMergeGap_s) {
      close();
    }
    sum.speed += row.speed * row.interval_s;
    sum.turn += row.turn * row.interval_s;
    sum.largest = std::max(sum.largest, row.largest);
    sum.interval_s += row.interval_s;
    end_s = row.time_s + 0.5 * row.interval_s;
    if (sum.interval_s >= kLeast_s) {
      close();
    }
  }
  close();
  return result;
}

void finish(WheelTrack& track) {
  track.rows = merged(track.rows);
  std::vector<double> moving;
  std::vector<double> intervals_s;
  for (const WheelRow& row : track.rows) {
    intervals_s.push_back(row.interval_s);
    if (row.largest > 0.0) {
      moving.push_back(row.largest);
    }
  }
  track.interval_s = intervals_s.empty() ? 0.0 : median(intervals_s);
  track.rest_speed = moving.empty() ? 0.0 : kRestShare * percentile(moving, 75.0);
}

/// In straight driving all wheels turn the same way: turning in place says nothing about signs.
double likeness(const JointRates& rates, std::size_t a, std::size_t b) {
  double sum = 0.0;
  for (const WheelSample& sample : rates.samples) {
    sum += sample.rate_radps[a] * sample.rate_radps[b];
  }
  return sum;
}

}  // namespace

bool hasSign(const WheelTrack& track) {
  return std::any_of(track.rows.begin(), track.rows.end(),
                     [&track](const WheelRow& row) { return row.speed < -track.rest_speed; });
}

JointRates ratesOf(const JointRecord& record, const std::vector<WheelJoint>& wheels, Nanoseconds origin) {
  JointRates rates;
  WheelDecoder decoder(asParameters(wheels), kLargestRate_radps);
  const std::vector<double> times_s = continuousTimes(timesOf(record), origin);
  for (std::size_t i = 0; i < record.samples.size(); ++i) {
    const RawJointSample& sample = record.samples[i];
    const std::optional<WheelSample> decoded =
        decoder.decode({fromSeconds(times_s[i]), record.names, sample.position_rad, sample.velocity_radps});
    addOnce(decoder.remark(), rates.remarks);
    addOnce(decoder.problem(), rates.problems);
    const bool is_newer = decoded && (rates.samples.empty() || decoded->stamp > rates.samples.back().stamp);
    if (is_newer) {
      rates.samples.push_back(*decoded);
    }
  }
  return rates;
}

void chooseSigns(const JointRates& rates, std::vector<WheelJoint>& wheels) {
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    wheels[i].sign = i == 0 || likeness(rates, 0, i) >= 0.0 ? 1.0 : -1.0;
  }
  double travelled = 0.0;
  for (const WheelSample& sample : rates.samples) {
    travelled += meanOf(sample, wheels, Side::kUnknown, false);
  }
  for (WheelJoint& wheel : wheels) {
    wheel.sign *= travelled < 0.0 ? -1.0 : 1.0;
  }
}

WheelTrack trackOf(const JointRates& rates, const std::vector<WheelJoint>& wheels) {
  WheelTrack track;
  const auto hasSide = [&wheels](Side side) {
    return std::any_of(wheels.begin(), wheels.end(), [side](const WheelJoint& wheel) { return wheel.side == side; });
  };
  track.has_turn = hasSide(Side::kLeft) && hasSide(Side::kRight);
  track.in_meters = !wheels.empty() && std::all_of(wheels.begin(), wheels.end(),
                                                   [](const WheelJoint& wheel) { return wheel.radius_m > 0.0; });
  for (std::size_t i = 1; i < rates.samples.size(); ++i) {
    const double interval_s = toSeconds(rates.samples[i].stamp - rates.samples[i - 1].stamp);
    if (interval_s < kLongest_s) {
      track.rows.push_back(rowOf(rates.samples[i], interval_s, wheels, track));
    }
  }
  finish(track);
  return track;
}

WheelTrack trackOf(const PoseRecord& odometry, Nanoseconds origin) {
  WheelTrack track;
  track.topic = odometry.topic;
  track.in_meters = true;
  track.turn_is_rate = true;
  const std::vector<double> times_s = continuousTimes(timesOf(odometry), origin);
  for (std::size_t i = 1; i < odometry.samples.size(); ++i) {
    const RawPoseSample& sample = odometry.samples[i];
    const double interval_s = times_s[i] - times_s[i - 1];
    const bool usable = std::isfinite(sample.forward_mps) && std::isfinite(sample.yaw_rate_radps);
    if (usable && interval_s > 0.0 && interval_s < kLongest_s) {
      track.rows.push_back({times_s[i] - 0.5 * interval_s, interval_s, sample.forward_mps, sample.yaw_rate_radps,
                            std::max(std::abs(sample.forward_mps), kTurnArm_m * std::abs(sample.yaw_rate_radps))});
      track.has_turn = track.has_turn || sample.yaw_rate_radps != 0.0;
    }
  }
  finish(track);
  return track;
}

}  // namespace slipnav
