#include "evaluation/endurance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace slipnav {
namespace {

EstimateSample estimateAt(const Vector3& position_enu_m, const Vector3& sigma_m) {
  EstimateSample estimate;
  estimate.position_enu_m = position_enu_m;
  estimate.covariance_enu_m2 = sigma_m.cwiseAbs2().asDiagonal();
  return estimate;
}

TEST(PositionError, IsJudgedInItsOwnDirection) {
  TruthSample truth;
  truth.position_enu_m = {10.0, 20.0, 5.0};
  const PositionError east = positionError(estimateAt({13.0, 20.0, 5.0}, {1.5, 50.0, 1.0}), truth);
  EXPECT_DOUBLE_EQ(east.horizontal_m, 3.0);
  EXPECT_DOUBLE_EQ(east.horizontal_3sigma_m, 4.5);
  EXPECT_DOUBLE_EQ(east.nees, 4.0 / 3.0);
  const PositionError up = positionError(estimateAt({10.0, 20.0, 7.0}, {1.0, 1.0, 1.0}), truth);
  EXPECT_EQ(up.horizontal_m, 0.0);
  EXPECT_DOUBLE_EQ(up.horizontal_3sigma_m, 3.0);
  EXPECT_DOUBLE_EQ(up.nees, 4.0 / 3.0);
}

TEST(PositionError, TheTruthHasACovarianceOfItsOwn) {
  TruthSample truth;
  truth.covariance_enu_m2 = Vector3(9.0, 9.0, 9.0).asDiagonal();
  const PositionError error = positionError(estimateAt({10.0, 0.0, 0.0}, {4.0, 4.0, 4.0}), truth);
  EXPECT_DOUBLE_EQ(error.horizontal_3sigma_m, 15.0);
  EXPECT_DOUBLE_EQ(error.nees, 4.0 / 3.0);
}

/// A row each minute of `hours`, which a test then changes.
std::vector<EnduranceRow> drive(double hours) {
  std::vector<EnduranceRow> rows;
  for (int minute = 1; minute <= 60.0 * hours; ++minute) {
    EnduranceRow row;
    row.driven_h = minute / 60.0;
    row.rss_kb = 30.0 * 1024.0;
    row.latency_p50_ms = 0.2;
    row.latency_p99_ms = 1.0;
    row.error = {1.0, 3.0, 1.0};
    rows.push_back(row);
  }
  return rows;
}

TEST(EnduranceFigures, MemoryCountsFromTheTenthMinute) {
  std::vector<EnduranceRow> rows = drive(3.0);
  rows[8].rss_kb = 1024.0;
  rows.back().rss_kb = 33.0 * 1024.0;
  EXPECT_DOUBLE_EQ(enduranceFigures(rows).memory_growth_mb, 3.0);
  rows[9].rss_kb = 31.0 * 1024.0;
  EXPECT_DOUBLE_EQ(enduranceFigures(rows).memory_growth_mb, 2.0);
}

TEST(EnduranceFigures, TheTrendIsFromTheFirstHourToTheLast) {
  std::vector<EnduranceRow> rows = drive(5.0);
  for (EnduranceRow& row : rows) {
    row.latency_p50_ms = row.driven_h < 0.16 ? 9.0 : row.driven_h < 1.16 ? 0.2 : row.driven_h < 3.99 ? 7.0 : 0.3;
    row.latency_p99_ms = 5.0 * row.latency_p50_ms;
  }
  rows[30].latency_p50_ms = 100.0;  // the machine was busy for a moment
  const EnduranceFigures figures = enduranceFigures(rows);
  EXPECT_EQ(figures.latency_p50_ms.first, 0.2);
  EXPECT_EQ(figures.latency_p50_ms.last, 0.3);
  EXPECT_EQ(figures.latency_p99_ms.first, 1.0);
  EXPECT_EQ(figures.latency_p99_ms.last, 1.5);
}

TEST(EnduranceFigures, AShortDriveHasHalvesInPlaceOfHours) {
  std::vector<EnduranceRow> rows = drive(1.0);
  for (EnduranceRow& row : rows) {
    row.latency_p50_ms = row.driven_h < 0.58 ? 1.0 : 2.0;
  }
  EXPECT_EQ(enduranceFigures(rows).latency_p50_ms.first, 1.0);
  EXPECT_EQ(enduranceFigures(rows).latency_p50_ms.last, 2.0);
}

TEST(EnduranceFigures, EveryRowCountsForConsistency) {
  std::vector<EnduranceRow> rows = drive(1.0);
  for (std::size_t i = 0; i < 6; ++i) {
    rows[i].error = {3.1, 3.0, 11.0};
  }
  EXPECT_DOUBLE_EQ(enduranceFigures(rows).covered_pct, 90.0);
  EXPECT_DOUBLE_EQ(enduranceFigures(rows).nees_mean, 2.0);
}

TEST(EnduranceFigures, ADriveThatEndsTooEarlyIsRefused) {
  EXPECT_THROW(enduranceFigures({}), std::invalid_argument);
  EXPECT_THROW(enduranceFigures(drive(10.0 / 60.0)), std::invalid_argument);
  EXPECT_NO_THROW(enduranceFigures(drive(11.0 / 60.0)));
}

TEST(EnduranceCsv, HasAValueForEachColumn) {
  const auto columns = [](const std::string& line) { return std::count(line.begin(), line.end(), ',') + 1; };
  EnduranceRow row;
  row.wall_s = 12.3;
  row.stops = 4;
  EXPECT_EQ(columns(enduranceCsv(row)), columns(enduranceCsvHeader()));
  EXPECT_EQ(enduranceCsv(row), "12.3,0.0000,0,0.000,0.000,0.000,0.000,0.000,4\n");
}

}  // namespace
}  // namespace slipnav
