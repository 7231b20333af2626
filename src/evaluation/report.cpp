#include "evaluation/report.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "core/base/atomic_file.h"
#include "evaluation/json_object.h"
#include "evaluation/tum.h"
#include "io/fields.h"

namespace slipnav {
namespace {

constexpr int kCsvDigits = 12;
constexpr const char* kComparePrefix = "compare_";

/// The number, or NaN, which streams as `nan`, if there is none.
double orNan(const std::optional<double>& value) { return value.value_or(std::numeric_limits<double>::quiet_NaN()); }

/// One column of the table: two header lines, and how the figures of a row are written.
struct Column {
  const char* group;
  const char* title;
  int decimals;
};

constexpr int kNameWidth = 20;
constexpr int kColumnWidth = 8;

constexpr std::array<Column, 12> kColumns = {{{"", "D m", 0},
                                              {"", "eps m", 1},
                                              {"", "stops", 0},
                                              {"", "T s", 0},
                                              {"error %", "ENU", 2},
                                              {"", "median", 2},
                                              {"horiz. m", "median", 2},
                                              {"", "std", 2},
                                              {"", "max", 2},
                                              {"RMS m", "east", 2},
                                              {"", "north", 2},
                                              {"", "up", 2}}};

std::string cell(const std::optional<double>& value, int decimals) {
  if (!value || !std::isfinite(*value)) {
    return "-";
  }
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed << std::setprecision(decimals) << *value;
  return out.str();
}

template <class CellOf>
std::string tableLine(const std::string& name, CellOf cellOf) {
  std::ostringstream out;
  out << std::left << std::setw(kNameWidth) << name << std::right;
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    out << ' ' << std::setw(kColumnWidth) << cellOf(i);
  }
  const std::string line = out.str();
  return line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
}

void addErrors(const Metrics& metrics, JsonObject& json) {
  json.addNumber("enu_error_pct", metrics.enu_error_pct);
  json.addNumber("median_error_pct", metrics.median_error_pct);
  json.addNumber("horizontal_median_m", metrics.horizontal_median_m);
  json.addNumber("horizontal_std_m", metrics.horizontal_std_m);
  json.addNumber("horizontal_max_m", metrics.horizontal_max_m);
  json.addNumber("horizontal_final_m", metrics.horizontal_final_m);
  json.addNumber("rms_east_m", metrics.rms_east_m);
  json.addNumber("rms_north_m", metrics.rms_north_m);
  json.addNumber("rms_up_m", metrics.rms_up_m);
  json.addNumber("position_nees_mean", metrics.position_nees_mean);
  json.addNumber("coverage_3sigma_pct", metrics.coverage_3sigma_pct);
}

/// Writes the file, or removes that of an earlier run if there is nothing to write.
void writeTumOrRemove(const std::string& path, const std::vector<TumPose>& poses) {
  if (poses.empty()) {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  } else {
    writeTum(path, poses);
  }
}

void writeSmoothed(const std::filesystem::path& folder, const std::optional<SmoothedRun>& smoothed) {
  const std::string timeline = (folder / "smoothed.csv").string();
  writeTumOrRemove((folder / "smoothed.tum").string(),
                   smoothed ? tumPoses(smoothed->estimates) : std::vector<TumPose>{});
  if (smoothed) {
    writeTimelineCsv(timeline, smoothed->estimates, smoothed->truth);
  } else {
    std::error_code ignored;
    std::filesystem::remove(timeline, ignored);
  }
}

/// Those of an earlier run.
void removeCompared(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (entry.path().filename().string().rfind(kComparePrefix, 0) == 0 &&
        (extension == ".csv" || extension == ".tum")) {
      std::error_code ignored;
      std::filesystem::remove(entry.path(), ignored);
    }
  }
}

void writeCompared(const std::filesystem::path& folder, const std::vector<OtherTrack>& others,
                   const TruthTrack& truth) {
  removeCompared(folder);
  for (const OtherTrack& other : others) {
    const std::string path = (folder / (kComparePrefix + other.name)).string();
    writeTum(path + ".tum", tumPoses(other.estimates));
    writeTimelineCsv(path + ".csv", other.estimates, truth);
  }
}

JsonObject errorsOf(const Metrics& metrics) {
  JsonObject errors;
  addErrors(metrics, errors);
  errors.addNumber("final_pct", metrics.final_pct);
  return errors;
}

}  // namespace

std::string metricsJson(const Metrics& metrics, const Metrics* smoothed, const std::vector<OtherTrack>& others) {
  JsonObject json;
  json.addNumber("distance_m", metrics.distance_m);
  json.addNumber("duration_s", metrics.duration_s);
  json.addCount("stop_count", metrics.stop_count);
  json.addNumber("stop_rate_pct", metrics.stop_rate_pct);
  addErrors(metrics, json);
  json.addNumber("wheel_only_error_pct", metrics.wheel_only_error_pct);
  json.addNumber("no_zupt_error_pct", metrics.no_zupt_error_pct);
  json.addCount("imu_samples", metrics.imu_samples);
  json.addCount("wheel_samples", metrics.wheel_samples);
  json.addCount("rejected_samples", metrics.rejected_samples);
  json.addCount("forecasts", metrics.forecasts);
  json.addNumber("forecast_ms_p50", metrics.forecast_ms_p50);
  json.addNumber("forecast_ms_p99", metrics.forecast_ms_p99);
  json.addNumber("cpu_s", metrics.cpu_s);
  json.addNumber("realtime_factor", metrics.realtime_factor);
  json.addNumber("final_pct", metrics.final_pct);
  json.addCount("stops_seen", metrics.stops_seen);
  json.addCount("stops_used", metrics.stops_used);
  json.addCount("truth_left_out", metrics.truth_left_out);
  json.addNumber("threshold_m", metrics.threshold_m);
  json.addCount("forecasts_judged", metrics.forecasts_judged);
  json.addNumber("forecast_horizon_s", metrics.forecast_horizon_s);
  json.addNumber("forecast_bound_m", metrics.forecast_bound_m);
  json.addNumber("forecast_growth_rms_m", metrics.forecast_growth_rms_m);
  json.addNumber("forecast_below_pct", metrics.forecast_below_pct);
  json.addNumber("closure_m", metrics.closure_m);
  json.addNumber("closure_up_m", metrics.closure_up_m);
  json.addNumber("closure_pct", metrics.closure_pct);
  json.addNumber("closure_3sigma_m", metrics.closure_3sigma_m);
  json.addNumber("largest_nis", metrics.largest_nis);
  json.addText("largest_nis_of", metrics.largest_nis_of);
  json.addText("verdict", metrics.verdict);
  json.addAlarms("problems", metrics.problems);
  json.addAlarms("alarms", metrics.alarms);
  if (smoothed != nullptr) {
    json.addObject("smoothed", errorsOf(*smoothed));
  }
  if (!others.empty()) {
    JsonObject compared;
    for (const OtherTrack& other : others) {
      compared.addObject(other.name.c_str(), errorsOf(other.metrics));
    }
    json.addObject("compared", compared);
  }
  return json.text();
}

void writeMetricsJson(const std::string& path, const Metrics& metrics, const Metrics* smoothed,
                      const std::vector<OtherTrack>& others) {
  AtomicFile file(path);
  file.stream() << metricsJson(metrics, smoothed, others);
  file.commit();
}

void writeTimelineCsv(const std::string& path, const EstimateTrack& estimates, const TruthTrack& truth) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "t,est_e,est_n,est_u,sigma_e,sigma_n,sigma_u,truth_e,truth_n,truth_u,speed,slip,stationary\n";
  out << std::setprecision(kCsvDigits);
  for (const EstimateSample& estimate : estimates) {
    const auto reference = truth.at(estimate.stamp);
    out << formatSeconds(estimate.stamp);
    writeVector(out, estimate.position_enu_m);
    writeVector(out, estimate.covariance_enu_m2.diagonal().cwiseMax(0.0).cwiseSqrt());
    writeVector(out, reference ? reference->position_enu_m : Vector3::Constant(orNan(std::nullopt)));
    out << ',' << estimate.speed_mps << ',' << orNan(estimate.slip) << ',' << (estimate.stationary ? 1 : 0) << '\n';
  }
  file.commit();
}

void writeForecastsCsv(const std::string& path, const std::vector<ForecastRow>& forecasts) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "t,horizon_s,horizontal_bound_m,time_to_stop_s\n" << std::setprecision(kCsvDigits);
  for (const ForecastRow& row : forecasts) {
    out << formatSeconds(row.stamp) << ',' << row.horizon_s << ',' << row.horizontal_bound_m << ','
        << orNan(row.time_to_stop_s) << '\n';
  }
  file.commit();
}

void writeRunReport(const std::string& directory, const RunReport& report) {
  createDirectories(directory);
  const std::filesystem::path folder(directory);
  writeTum((folder / "estimate.tum").string(), tumPoses(report.estimates));
  writeTumOrRemove((folder / "truth.tum").string(), tumPoses(report.truth));
  writeSmoothed(folder, report.smoothed);
  writeCompared(folder, report.others, report.truth);
  writeTimelineCsv((folder / "timeline.csv").string(), report.estimates, report.truth);
  writeForecastsCsv((folder / "forecasts.csv").string(), report.forecasts);
  writeFilterCsv((folder / "filter.csv").string(), report.diagnostics.filter);
  writeWheelTrackCsv((folder / "wheel_track.csv").string(), report.diagnostics.wheel_only);
  writeSlipForecastsCsv((folder / "slip_forecasts.csv").string(), report.diagnostics.slip_forecasts);
  writeNeesCsv((folder / "nees.csv").string(), report.estimates, report.truth);
  writeMetricsJson((folder / "metrics.json").string(), report.metrics, report.smoothedMetrics(), report.others);
}

std::string tableHeader() {
  const auto group = [](std::size_t i) { return std::string(kColumns[i].group); };
  const auto title = [](std::size_t i) { return std::string(kColumns[i].title); };
  return tableLine("", group) + tableLine("", title);
}

std::string tableRow(const std::string& name, std::optional<double> threshold_m, const Metrics& metrics) {
  const std::array<std::optional<double>, kColumns.size()> values = {metrics.distance_m,
                                                                     threshold_m,
                                                                     static_cast<double>(metrics.stop_count),
                                                                     metrics.duration_s,
                                                                     metrics.enu_error_pct,
                                                                     metrics.median_error_pct,
                                                                     metrics.horizontal_median_m,
                                                                     metrics.horizontal_std_m,
                                                                     metrics.horizontal_max_m,
                                                                     metrics.rms_east_m,
                                                                     metrics.rms_north_m,
                                                                     metrics.rms_up_m};
  return tableLine(name, [&values](std::size_t i) { return cell(values[i], kColumns[i].decimals); });
}

std::string tableRows(const std::string& name, std::optional<double> threshold_m, const RunReport& report) {
  std::string rows = tableRow(name, threshold_m, report.metrics);
  if (report.smoothed) {
    rows += tableRow("  (smoothed)", threshold_m, report.smoothed->metrics);
  }
  for (const OtherTrack& other : report.others) {
    rows += tableRow("  " + other.name, threshold_m, other.metrics);
  }
  return rows;
}

}  // namespace slipnav
