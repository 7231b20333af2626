#include "evaluation/verdict.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

Metrics goodRun() {
  Metrics metrics;
  metrics.position_nees_mean = 1.0;
  metrics.coverage_3sigma_pct = 100.0;
  metrics.final_pct = 0.2;
  metrics.wheel_only_error_pct = 1.0;
  metrics.stops_seen = 6;
  metrics.stops_used = 6;
  return metrics;
}

TEST(Verdict, namesConsistency) {
  Metrics metrics = goodRun();
  EXPECT_EQ(verdictOf(metrics, true), "consistent");
  metrics.position_nees_mean = 0.1;
  EXPECT_EQ(verdictOf(metrics, true), "cautious");
  metrics.position_nees_mean = 76.0;
  metrics.coverage_3sigma_pct = 42.6;
  EXPECT_EQ(verdictOf(metrics, true), "over-confident: 3 sigma covers 42.6 % of the errors, NEES 76");
  EXPECT_EQ(verdictOf(Metrics{}, true), "not judged: no truth");
}

TEST(Verdict, namesTheMeasurementThatContradictsMost) {
  Metrics metrics = goodRun();
  metrics.largest_nis = 40.0;
  metrics.largest_nis_of = "forward_speed";
  EXPECT_EQ(verdictOf(metrics, true), "consistent");
  metrics.position_nees_mean = 76.0;
  metrics.coverage_3sigma_pct = 42.6;
  EXPECT_EQ(verdictOf(metrics, true),
            "over-confident: 3 sigma covers 42.6 % of the errors, NEES 76, NIS of forward speed 40");
  Metrics without_truth;
  without_truth.largest_nis = 40.0;
  without_truth.largest_nis_of = "forward_speed";
  EXPECT_EQ(verdictOf(without_truth, true),
            "over-confident: NIS of forward speed 40; no truth to judge the position by");
  without_truth.largest_nis = 1.1;
  EXPECT_EQ(verdictOf(without_truth, true), "not judged: no truth");
}

TEST(Verdict, namesWhatIsWorseThanWheelsAndGyro) {
  Metrics metrics = goodRun();
  metrics.final_pct = 1.6;
  EXPECT_EQ(verdictOf(metrics, true),
            "consistent; worse than wheels and gyro alone: 1.6 % of the distance at the end, not 1 %");
  metrics.final_pct = 1.4;
  EXPECT_EQ(verdictOf(metrics, true), "consistent");
}

TEST(Verdict, namesStopsThatWereNotUsed) {
  Metrics metrics = goodRun();
  metrics.stops_used = 4;
  EXPECT_EQ(verdictOf(metrics, true), "consistent; stops seen but not used: 2 of 6");
  EXPECT_EQ(verdictOf(metrics, false), "consistent");
}

}  // namespace
}  // namespace slipnav
