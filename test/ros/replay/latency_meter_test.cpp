#include "ros/replay/latency_meter.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace slipnav {
namespace {

std::vector<std::string> report(LatencyMeter& meter) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  meter.report(status);
  std::vector<std::string> values;
  for (const diagnostic_msgs::KeyValue& line : status.values) {
    values.push_back(line.value);
  }
  return values;
}

TEST(Arrivals, AreKnownByTheirStamp) {
  Arrivals arrivals;
  arrivals.note(1, 10.0);
  arrivals.note(2, 10.5);
  EXPECT_EQ(arrivals.of(1), 10.0);
  EXPECT_EQ(arrivals.of(2), 10.5);
  EXPECT_EQ(arrivals.of(3), 0.0);
}

TEST(Arrivals, AfterAClockThatWentBackTheNewOneCounts) {
  Arrivals arrivals;
  arrivals.note(1, 10.0);
  arrivals.note(2, 10.5);
  arrivals.note(1, 11.0);
  EXPECT_EQ(arrivals.of(1), 11.0);
}

TEST(LatencyMeter, CountsFromTheImuSampleOfTheEstimate) {
  LatencyMeter meter;
  meter.expect(1, 10.000);
  meter.expect(2, 10.020);
  meter.published(1, 10.030);
  meter.published(2, 10.040);
  EXPECT_EQ(report(meter), (std::vector<std::string>{"25.00", "29.90", "30.00"}));
}

TEST(LatencyMeter, WhatIsMechanizedAgainIsAsOldAsBefore) {
  LatencyMeter meter;
  meter.expect(1, 10.0);
  meter.expect(1, 10.5);
  meter.published(1, 11.0);
  EXPECT_EQ(report(meter).back(), "1000.00");
}

TEST(LatencyMeter, ReportsOnlyWhatIsNew) {
  LatencyMeter meter;
  meter.expect(1, 10.0);
  meter.published(1, 10.1);
  report(meter);
  EXPECT_TRUE(report(meter).empty());
}

TEST(LatencyMeter, SamplesThatAreNotKnownDoNotCount) {
  LatencyMeter meter;
  meter.expect(1, 0.0);
  meter.published(1, 11.5);
  meter.published(2, 11.5);
  EXPECT_TRUE(report(meter).empty());
}

TEST(LatencyMeter, ANewStartForgetsWhatNeverComes) {
  LatencyMeter meter;
  meter.expect(5, 10.0);
  meter.restart();
  meter.published(5, 11.0);
  EXPECT_TRUE(report(meter).empty());
}

}  // namespace
}  // namespace slipnav
