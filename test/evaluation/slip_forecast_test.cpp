#include "evaluation/slip_forecast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "support/gp_golden.h"

namespace slipnav {
namespace {

/// A file that is gone after the test.
class TemporaryCsv {
 public:
  explicit TemporaryCsv(const std::string& text) : path_(::testing::TempDir() + "slipnav_slip_forecast.csv") {
    std::ofstream(path_) << text;
  }
  ~TemporaryCsv() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string messageOf(const std::string& path) {
  try {
    readSlipCsv(path);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(SlipForecast, ReadsRowsWithAndWithoutHeader) {
  for (const char* header : {"", "time_s,slip\n", "# time_s, slip\n"}) {
    const TemporaryCsv file(header + std::string("1.5,0.25\n\n 1.6 , -1e-2\r\n1.7,nan\n"));
    const SlipSamples samples = readSlipCsv(file.path());
    ASSERT_EQ(samples.slips.size(), 3U);
    EXPECT_EQ(samples.times_s[0], 1.5);
    EXPECT_EQ(samples.slips[1], -0.01);
    EXPECT_TRUE(std::isnan(samples.slips[2]));
    EXPECT_FALSE(samples.origin_s.has_value());
  }
}

TEST(SlipForecast, NamesFileAndLineOfAWrongRow) {
  const TemporaryCsv file("1.5,0.25\n1.6;0.3\n");
  EXPECT_NE(messageOf(file.path()).find(file.path() + ":2"), std::string::npos);
  EXPECT_NE(messageOf("/nowhere/slip.csv").find("/nowhere/slip.csv"), std::string::npos);
}

TEST(SlipForecast, PredictsEveryTenthOfASecondUpToTheHorizon) {
  const SlipSamples samples = readGpSlip();
  const SlipForecastResult forecast = forecastSlip(samples, SlipModelParameters(), 60.0);
  const Eigen::VectorXd& times_s = forecast.prediction.times_s;
  ASSERT_EQ(times_s.size(), 600);
  EXPECT_NEAR(times_s(0), samples.times_s.back() + 0.1, 1e-9);
  EXPECT_NEAR(times_s(599), samples.times_s.back() + 60.0, 1e-9);
  EXPECT_EQ(forecast.model, "paper");
  EXPECT_EQ(forecast.fit.status, SlipFitStatus::kConverged);
  EXPECT_NEAR(forecast.fit.log_marginal_likelihood, 212.90, 0.02);
}

TEST(SlipForecast, JsonHasTheKeysAndAllDigits) {
  SlipForecastResult forecast = forecastSlip(readGpSlip(), SlipModelParameters(), 1.0);
  forecast.fit.origin_s = 0.1 + 0.2;
  const std::string json = toJson(forecast);
  for (const char* key : {"\"model\": \"paper\"", "\"status\": \"converged\"", "\"origin_s\": 0.30000000000000004",
                          "\"hyperparameters\": {", "\"variance\": ", "\"length_scale_s\": ", "\"noise_variance\": ",
                          "\"log_marginal_likelihood\": 212.", "\"t\": [", "\"mean\": [", "\"stddev\": ["}) {
    EXPECT_NE(json.find(key), std::string::npos) << key;
  }
  EXPECT_EQ(json.find("nan"), std::string::npos);
}

TEST(SlipForecast, SummaryIsADozenLinesWithTheValuesOfTheForecast) {
  const SlipForecastResult forecast = forecastSlip(readGpSlip(), SlipModelParameters(), 60.0);
  const std::string summary = summaryOf(forecast);
  EXPECT_EQ(std::count(summary.begin(), summary.end(), '\n'), 10);
  EXPECT_NE(summary.find("model paper: converged"), std::string::npos) << summary;
  std::array<char, 64> row = {};
  for (const int step : {10, 20, 50, 100, 200, 500, 600}) {
    std::snprintf(row.data(), row.size(), "\n%10.1f%10.4f      %10.4f\n", 0.1 * step,
                  forecast.prediction.mean(step - 1), 2.0 * forecast.prediction.stddev(step - 1));
    EXPECT_NE(summary.find(row.data()), std::string::npos) << row.data() << summary;
  }
}

TEST(SlipForecast, RefusalIsAnErrorWithItsReason) {
  try {
    forecastSlip({{1.0, 2.0}, {0.1, 0.2}, {}}, SlipModelParameters(), 60.0);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("too few samples"), std::string::npos);
  }
  EXPECT_THROW(forecastSlip(readGpSlip(), SlipModelParameters(), 0.1), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav
