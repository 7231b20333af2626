#include "ros/replay/endurance_watch.h"

#include <ros/time.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/statistics.h"
#include "evaluation/limit_table.h"
#include "ros/messages/conversions.h"

namespace slipnav {
namespace {

constexpr double kRowInterval_s = 60.0;
constexpr std::size_t kRowsInAnHour = 60;

constexpr double kMostGrowth_mb = 2.0;
constexpr double kMostTrend = 1.5;     // latency of the last hour relative to the first
constexpr double kLongestGap_s = 0.1;  // no estimate may be missing
constexpr double kLeastCovered_pct = 99.0;
/// 99 % of chi-square with three degrees of freedom, over three: the errors of one drive count as one sample.
constexpr double kMostNees = 3.78;

double now() { return ros::SteadyTime::now().toSec(); }

std::string hourText(const EnduranceRow& row) {
  char text[200];
  std::snprintf(text, sizeof text,
                "soak: %5.2f h, %3.0f times real time, %.1f MB, latency %.2f / %.2f ms, error %.1f m of %.1f m, "
                "NEES %.2f, %d stops\n",
                row.driven_h, 3600.0 * row.driven_h / row.wall_s, row.rss_kb / 1024.0, row.latency_p50_ms,
                row.latency_p99_ms, row.error.horizontal_m, row.error.horizontal_3sigma_m, row.error.nees, row.stops);
  return text;
}

void addTrend(const std::string& name, const Trend& trend, LimitTable& table) {
  table.add(name + ", first hour [ms]", trend.first);
  table.add(name + ", last hour [ms]", trend.last);
  table.addAtMost(name + ", last hour / first hour", trend.last / trend.first, kMostTrend);
}

}  // namespace

EnduranceWatch::EnduranceWatch(const Planet& planet, double hours, const std::string& folder,
                               std::function<double()> memory_kb)
    : planet_(planet), hours_(hours), folder_(folder), memory_kb_(std::move(memory_kb)) {
  createDirectories(folder_);
  csv_.open(folder_ + "/soak.csv");
  csv_ << enduranceCsvHeader();
}

void EnduranceWatch::add(const Initialization& message) {
  if (message.done) {
    const Geodetic origin{degToRad(message.latitude_deg), degToRad(message.longitude_deg), message.height_m};
    frame_.emplace(planet_, origin);
  }
}

void EnduranceWatch::add(const sim::Measurements& measurements, const sim::TruthState&) {
  published_.note(measurements.imu.stamp, now());
  const std::optional<GnssFix>& fix = measurements.truth;
  if (frame_ && first_ != 0 && fix && fix->stamp >= next_row_ && !truth_) {
    truth_ = TruthTrack::fromFixes({*fix}, *frame_).samples().front();
  }
}

void EnduranceWatch::add(const nav_msgs::Odometry& message) {
  const EstimateSample estimate = toEstimateSample(message);
  const double now_s = now();
  if (first_ == 0) {
    first_ = estimate.stamp;
    begun_s_ = now_s;
    next_row_ = first_ + fromSeconds(kRowInterval_s);
  } else {
    longest_gap_s_ = std::max(longest_gap_s_, toSeconds(estimate.stamp - newest_.stamp));
  }
  if (const double published_s = published_.of(estimate.stamp)) {
    latencies_ms_.push_back(1e3 * (now_s - published_s));
  }
  if (truth_ && estimate.stamp >= truth_->stamp) {
    addRow({newest_, estimate}, *std::exchange(truth_, std::nullopt));
  }
  newest_ = estimate;
}

void EnduranceWatch::addRow(const EstimateTrack& around, const TruthSample& truth) {
  next_row_ += fromSeconds(kRowInterval_s);
  const std::optional<EstimateSample> estimate = interpolate(around, truth.stamp, kRowInterval_s);
  if (!estimate || latencies_ms_.empty()) {
    return;
  }
  EnduranceRow row;
  row.wall_s = now() - begun_s_;
  row.driven_h = toSeconds(truth.stamp - first_) / 3600.0;
  row.rss_kb = memory_kb_();
  row.latency_p50_ms = percentile(latencies_ms_, 50.0);
  row.latency_p99_ms = percentile(latencies_ms_, 99.0);
  row.error = positionError(*estimate, truth);
  row.stops = stops_;
  latencies_ms_.clear();
  rows_.push_back(row);
  csv_ << enduranceCsv(row) << std::flush;
  if (rows_.size() % kRowsInAnHour == 0) {
    std::cout << hourText(row) << std::flush;
  }
}

std::string EnduranceWatch::verdict() {
  const EnduranceFigures figures = enduranceFigures(rows_);
  const EnduranceRow& last = rows_.back();
  LimitTable table;
  table.add("driven [h]", last.driven_h);
  table.add("stops", last.stops);
  table.addAtMost("longest interval between estimates [s]", longest_gap_s_, kLongestGap_s);
  table.add("memory of the manager at the end [MB]", last.rss_kb / 1024.0);
  table.addAtMost("its growth after the first 10 minutes [MB]", figures.memory_growth_mb, kMostGrowth_mb);
  addTrend("latency p50", figures.latency_p50_ms, table);
  addTrend("latency p99", figures.latency_p99_ms, table);
  table.add("horizontal error at the end [m]", last.error.horizontal_m);
  table.add("3 sigma of it [m]", last.error.horizontal_3sigma_m);
  table.addAtLeast("minutes with the error within 3 sigma [%]", figures.covered_pct, kLeastCovered_pct);
  table.addAtMost("position NEES, mean", figures.nees_mean, kMostNees);
  AtomicFile file(folder_ + "/soak.txt");
  file.stream() << table.text();
  file.commit();
  return table.text();
}

}  // namespace slipnav
