#include "evaluation/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

#include "core/base/atomic_file.h"

namespace slipnav {
namespace {

namespace fs = std::filesystem;

class Report : public ::testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (fs::path(folder_) / name).string(); }

  std::string contentOf(const std::string& name) const {
    std::ifstream file(path(name));
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  std::vector<std::string> filesInFolder() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  const std::string folder_ = ::testing::TempDir() + "slipnav_report_test/nested";
};

RunReport smallReport() {
  RunReport report;
  EstimateSample estimate;
  estimate.stamp = 1'602'774'000'500'000'000;
  estimate.position_enu_m = {1.5, 2.5, -0.25};
  estimate.covariance_enu_m2 = Vector3(0.25, 4.0, 9.0).asDiagonal();
  estimate.speed_mps = 0.75;
  estimate.slip = 0.125;
  report.estimates.push_back(estimate);
  estimate.stamp += 20'000'001;
  estimate.slip.reset();
  estimate.stationary = true;
  report.estimates.push_back(estimate);
  TruthSample truth;
  truth.stamp = report.estimates[0].stamp;
  truth.position_enu_m = {1.0, 2.0, 3.0};
  report.truth = TruthTrack({truth});
  report.forecasts = {{1'602'774'000'500'000'000, 1.0, 0.5, 12.25}, {1'602'774'000'500'000'000, 2.0, 0.75, {}}};
  report.metrics.distance_m = 0.1;
  report.metrics.stop_count = 3;
  return report;
}

TEST_F(Report, writesTheTimelineWithItsColumns) {
  writeRunReport(folder_, smallReport());
  EXPECT_EQ(contentOf("timeline.csv"),
            "t,est_e,est_n,est_u,sigma_e,sigma_n,sigma_u,truth_e,truth_n,truth_u,speed,slip,stationary\n"
            "1602774000.500000000,1.5,2.5,-0.25,0.5,2,3,1,2,3,0.75,0.125,0\n"
            "1602774000.520000001,1.5,2.5,-0.25,0.5,2,3,nan,nan,nan,0.75,nan,1\n");
}

TEST_F(Report, writesTheForecastsWithTheirColumns) {
  writeRunReport(folder_, smallReport());
  EXPECT_EQ(contentOf("forecasts.csv"),
            "t,horizon_s,horizontal_bound_m,time_to_stop_s\n"
            "1602774000.500000000,1,0.5,12.25\n"
            "1602774000.500000000,2,0.75,nan\n");
}

TEST_F(Report, writesTheStateOfTheFilter) {
  RunReport report = smallReport();
  FilterRow row;
  row.stamp = 1'602'774'000'500'000'000;
  row.wheel_speed_mps = 0.75;
  row.accel_bias_flu_mps2 = {1.0, 2.0, 3.0};
  row.accel_sigma_mps2 = {4.0, 5.0, 6.0};
  row.gyro_bias_flu_radps = {7.0, 8.0, 9.0};
  row.gyro_sigma_radps = {10.0, 11.0, 12.0};
  row.nis[kForwardSpeed] = 0.5;
  row.nis[kZeroRate] = 1.5;
  report.diagnostics.filter = {row};
  writeRunReport(folder_, report);
  EXPECT_EQ(contentOf("filter.csv"),
            "t,wheel_speed,accel_bias_x,accel_bias_y,accel_bias_z,accel_sigma_x,accel_sigma_y,accel_sigma_z,"
            "gyro_bias_x,gyro_bias_y,gyro_bias_z,gyro_sigma_x,gyro_sigma_y,gyro_sigma_z,nis_forward_speed,"
            "nis_yaw_rate,nis_lateral,nis_vertical,nis_zero_velocity,nis_zero_rate,nis_fix_position,nis_fix_velocity\n"
            "1602774000.500000000,0.75,1,2,3,4,5,6,7,8,9,10,11,12,0.5,nan,nan,nan,nan,1.5,nan,nan\n");
}

TEST_F(Report, writesBaselineAndSlipForecasts) {
  RunReport report = smallReport();
  report.diagnostics.wheel_only = {{1'602'774'000'500'000'000, 1.5, 2.5, 0.0}};
  report.diagnostics.slip_forecasts = {{1'602'774'000'500'000'000, 0.1, 0.25, 0.125, {0.8, 0.9, 0.75}}};
  writeRunReport(folder_, report);
  EXPECT_EQ(contentOf("wheel_track.csv"), "t,east,north\n1602774000.500000000,1.5,2.5\n");
  EXPECT_EQ(contentOf("slip_forecasts.csv"),
            "t,horizon_s,mean,stddev,wheel_speed,wheel_speed_above,wheel_speed_below\n"
            "1602774000.500000000,0.1,0.25,0.125,0.8,0.9,0.75\n");
}

TEST_F(Report, writesTheNeesOfThePosition) {
  writeRunReport(folder_, smallReport());
  // Errors of 0.5, 0.5 and -3.25 m; variances 0.25, 4 and 9.
  EXPECT_EQ(contentOf("nees.csv"),
            "t,nees,truth_sigma_e,truth_sigma_n,truth_sigma_u\n1602774000.500000000,2.2361111,0,0,0\n");
}

TEST_F(Report, leavesAllFilesAndNothingElse) {
  writeRunReport(folder_, smallReport());
  EXPECT_EQ(filesInFolder(),
            (std::vector<std::string>{"estimate.tum", "filter.csv", "forecasts.csv", "metrics.json", "nees.csv",
                                      "slip_forecasts.csv", "timeline.csv", "truth.tum", "wheel_track.csv"}));
  RunReport without_truth = smallReport();
  without_truth.truth = TruthTrack();
  writeRunReport(folder_, without_truth);
  EXPECT_EQ(filesInFolder(),
            (std::vector<std::string>{"estimate.tum", "filter.csv", "forecasts.csv", "metrics.json", "nees.csv",
                                      "slip_forecasts.csv", "timeline.csv", "wheel_track.csv"}));
}

TEST_F(Report, writesTheSmoothedDriveAndRemovesThatOfAnEarlierRun) {
  RunReport report = smallReport();
  SmoothedRun smoothed;
  smoothed.estimates = {report.estimates[0]};
  smoothed.estimates[0].position_enu_m.x() = 1.25;
  smoothed.truth = report.truth;
  smoothed.metrics.rms_east_m = 0.25;
  report.smoothed = smoothed;
  writeRunReport(folder_, report);
  EXPECT_EQ(contentOf("smoothed.csv"),
            "t,est_e,est_n,est_u,sigma_e,sigma_n,sigma_u,truth_e,truth_n,truth_u,speed,slip,stationary\n"
            "1602774000.500000000,1.25,2.5,-0.25,0.5,2,3,1,2,3,0.75,0.125,0\n");
  EXPECT_EQ(contentOf("smoothed.tum").substr(0, 32), "1602774000.500000000 1.250000000");
  const std::string json = contentOf("metrics.json");
  const std::size_t object = json.find("\n  \"smoothed\": {\n    \"enu_error_pct\": null,\n");
  ASSERT_NE(object, std::string::npos);
  EXPECT_NE(json.find("\n    \"rms_east_m\": 0.25,\n", object), std::string::npos);
  EXPECT_EQ(json.substr(json.find("final_pct", object)), "final_pct\": null\n  }\n}\n");
  writeRunReport(folder_, smallReport());
  const std::vector<std::string> files = filesInFolder();
  EXPECT_EQ(std::count_if(files.begin(), files.end(), [](const auto& name) { return name.rfind("smoothed", 0) == 0; }),
            0);
  EXPECT_EQ(contentOf("metrics.json").find("smoothed"), std::string::npos);
}

TEST_F(Report, namesADirectoryItCannotCreate) {
  fs::create_directories(fs::path(folder_).parent_path());
  std::ofstream(folder_) << "a file stands in the way";
  try {
    writeRunReport(folder_, smallReport());
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(folder_), std::string::npos);
  }
}

TEST_F(Report, atomicFileLeavesTheOldOneUntilCommitted) {
  createDirectories(folder_);
  std::ofstream(path("a.txt")) << "old";
  {
    AtomicFile file(path("a.txt"));
    file.stream() << "half";
  }
  EXPECT_EQ(contentOf("a.txt"), "old");
  EXPECT_EQ(filesInFolder(), std::vector<std::string>{"a.txt"});
  AtomicFile file(path("a.txt"));
  file.stream() << "new";
  file.commit();
  EXPECT_EQ(contentOf("a.txt"), "new");
  EXPECT_EQ(filesInFolder(), std::vector<std::string>{"a.txt"});
}

TEST_F(Report, atomicFileNamesAPathItCannotReplace) {
  createDirectories(path("taken/inside"));
  AtomicFile file(path("taken"));
  try {
    file.commit();
    FAIL() << "a directory was replaced";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(path("taken")), std::string::npos);
  }
}

TEST(MetricsJson, holdsEveryKeyInOrder) {
  Metrics metrics;
  metrics.distance_m = 0.1;
  metrics.duration_s = 60.0;
  metrics.stop_count = 3;
  metrics.rms_up_m = std::numeric_limits<double>::infinity();
  metrics.imu_samples = 12345678901;
  EXPECT_EQ(metricsJson(metrics),
            "{\n"
            "  \"distance_m\": 0.1,\n"
            "  \"duration_s\": 60,\n"
            "  \"stop_count\": 3,\n"
            "  \"stop_rate_pct\": null,\n"
            "  \"enu_error_pct\": null,\n"
            "  \"median_error_pct\": null,\n"
            "  \"horizontal_median_m\": null,\n"
            "  \"horizontal_std_m\": null,\n"
            "  \"horizontal_max_m\": null,\n"
            "  \"horizontal_final_m\": null,\n"
            "  \"rms_east_m\": null,\n"
            "  \"rms_north_m\": null,\n"
            "  \"rms_up_m\": null,\n"
            "  \"position_nees_mean\": null,\n"
            "  \"coverage_3sigma_pct\": null,\n"
            "  \"wheel_only_error_pct\": null,\n"
            "  \"no_zupt_error_pct\": null,\n"
            "  \"imu_samples\": 12345678901,\n"
            "  \"wheel_samples\": 0,\n"
            "  \"rejected_samples\": 0,\n"
            "  \"forecasts\": 0,\n"
            "  \"forecast_ms_p50\": null,\n"
            "  \"forecast_ms_p99\": null,\n"
            "  \"cpu_s\": null,\n"
            "  \"realtime_factor\": null,\n"
            "  \"final_pct\": null,\n"
            "  \"stops_seen\": 0,\n"
            "  \"stops_used\": 0,\n"
            "  \"truth_left_out\": 0,\n"
            "  \"threshold_m\": null,\n"
            "  \"forecasts_judged\": 0,\n"
            "  \"forecast_horizon_s\": null,\n"
            "  \"forecast_bound_m\": null,\n"
            "  \"forecast_growth_rms_m\": null,\n"
            "  \"forecast_below_pct\": null,\n"
            "  \"closure_m\": null,\n"
            "  \"closure_up_m\": null,\n"
            "  \"closure_pct\": null,\n"
            "  \"closure_3sigma_m\": null,\n"
            "  \"largest_nis\": null,\n"
            "  \"largest_nis_of\": \"\",\n"
            "  \"verdict\": \"\",\n"
            "  \"problems\": [],\n"
            "  \"alarms\": []\n"
            "}\n");
}

/// Value that follows a key.
double valueOf(const std::string& json, const std::string& key) {
  const std::size_t at = json.find("\"" + key + "\": ");
  return at == std::string::npos ? -1.0 : std::stod(json.substr(at + key.size() + 4));
}

TEST(MetricsJson, givesEachKeyItsOwnFigure) {
  Metrics m;
  m.distance_m = 1.5, m.duration_s = 2.5, m.stop_count = 3, m.stop_rate_pct = 4.5, m.enu_error_pct = 5.5;
  m.median_error_pct = 6.5, m.horizontal_median_m = 7.5, m.horizontal_std_m = 8.5, m.horizontal_max_m = 9.5;
  m.horizontal_final_m = 10.5, m.rms_east_m = 11.5, m.rms_north_m = 12.5, m.rms_up_m = 13.5;
  m.position_nees_mean = 14.5, m.coverage_3sigma_pct = 15.5, m.wheel_only_error_pct = 16.5;
  m.no_zupt_error_pct = 17.5, m.imu_samples = 18, m.wheel_samples = 19, m.rejected_samples = 20, m.forecasts = 21;
  m.forecast_ms_p50 = 22.5, m.forecast_ms_p99 = 23.5, m.cpu_s = 24.5, m.realtime_factor = 25.5;
  m.final_pct = 26.5, m.stops_seen = 27, m.stops_used = 28, m.threshold_m = 29.5;
  m.forecasts_judged = 30, m.forecast_horizon_s = 31.5, m.forecast_bound_m = 32.5, m.forecast_growth_rms_m = 33.5;
  m.forecast_below_pct = 34.5, m.closure_m = 35.5, m.closure_up_m = 36.5, m.closure_pct = 37.5;
  m.closure_3sigma_m = 38.5, m.largest_nis = 39.5;
  const std::string json = metricsJson(m);
  const std::vector<std::string> keys = {"distance_m",
                                         "duration_s",
                                         "stop_count",
                                         "stop_rate_pct",
                                         "enu_error_pct",
                                         "median_error_pct",
                                         "horizontal_median_m",
                                         "horizontal_std_m",
                                         "horizontal_max_m",
                                         "horizontal_final_m",
                                         "rms_east_m",
                                         "rms_north_m",
                                         "rms_up_m",
                                         "position_nees_mean",
                                         "coverage_3sigma_pct",
                                         "wheel_only_error_pct",
                                         "no_zupt_error_pct",
                                         "imu_samples",
                                         "wheel_samples",
                                         "rejected_samples",
                                         "forecasts",
                                         "forecast_ms_p50",
                                         "forecast_ms_p99",
                                         "cpu_s",
                                         "realtime_factor",
                                         "final_pct",
                                         "stops_seen",
                                         "stops_used",
                                         "threshold_m",
                                         "forecasts_judged",
                                         "forecast_horizon_s",
                                         "forecast_bound_m",
                                         "forecast_growth_rms_m",
                                         "forecast_below_pct",
                                         "closure_m",
                                         "closure_up_m",
                                         "closure_pct",
                                         "closure_3sigma_m",
                                         "largest_nis"};
  for (std::size_t i = 0; i < keys.size(); ++i) {
    EXPECT_EQ(std::floor(valueOf(json, keys[i])), static_cast<double>(i + 1)) << keys[i];
  }
}

TEST(Table, alignsTheRowWithItsHeader) {
  Metrics metrics;
  metrics.distance_m = 671.0;
  metrics.stop_count = 8;
  metrics.duration_s = 879.0;
  metrics.enu_error_pct = 3.07;
  metrics.median_error_pct = 1.73;
  metrics.horizontal_median_m = 11.6;
  metrics.horizontal_std_m = 12.01;
  metrics.horizontal_max_m = 34.48;
  metrics.rms_east_m = 17.84;
  metrics.rms_north_m = 7.26;
  const std::string expected =
      "                                                          error %          horiz. m                      RMS m\n"
      "                          D m    eps m    stops      T s      ENU   median   median      std      max     east"
      "    north       up\n"
      "Test1                     671      5.0        8      879     3.07     1.73    11.60    12.01    34.48    17.84"
      "     7.26        -\n";
  EXPECT_EQ(tableHeader() + tableRow("Test1", 5.0, metrics), expected);
}

TEST(Table, showsWhatIsNotKnown) {
  const std::string row = tableRow("no truth", std::nullopt, Metrics());
  EXPECT_NE(row.find("no truth                    -        -        0        0        -"), std::string::npos) << row;
}

TEST(Table, hasASecondRowForTheSmoothedDrive) {
  RunReport report;
  report.metrics.rms_up_m = 2.0;
  EXPECT_EQ(tableRows("Test1", 5.0, report), tableRow("Test1", 5.0, report.metrics));
  report.smoothed.emplace();
  report.smoothed->metrics.rms_up_m = 1.0;
  EXPECT_EQ(tableRows("Test1", 5.0, report),
            tableRow("Test1", 5.0, report.metrics) + tableRow("  (smoothed)", 5.0, report.smoothed->metrics));
}

}  // namespace
}  // namespace slipnav
