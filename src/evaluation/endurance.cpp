#include "evaluation/endurance.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "core/base/statistics.h"

namespace slipnav {
namespace {

using Rows = std::vector<EnduranceRow>;

std::vector<double> column(Rows::const_iterator begin, Rows::const_iterator end, double EnduranceRow::*figure) {
  std::vector<double> values;
  std::transform(begin, end, std::back_inserter(values), [figure](const EnduranceRow& row) { return row.*figure; });
  return values;
}

Trend trendOf(Rows::const_iterator begin, Rows::const_iterator end, double EnduranceRow::*figure) {
  const double span_h = std::min(1.0, 0.5 * (std::prev(end)->driven_h - begin->driven_h));
  const auto isBefore = [](const EnduranceRow& row, double driven_h) { return row.driven_h < driven_h; };
  const auto first_end = std::lower_bound(std::next(begin), end, begin->driven_h + span_h, isBefore);
  const auto last_begin = std::lower_bound(begin, std::prev(end), std::prev(end)->driven_h - span_h, isBefore);
  return {median(column(begin, first_end, figure)), median(column(last_begin, end, figure))};
}

}  // namespace

PositionError positionError(const EstimateSample& estimate, const TruthSample& truth) {
  const Vector3 error_m = estimate.position_enu_m - truth.position_enu_m;
  const Matrix3 covariance_m2 = estimate.covariance_enu_m2 + truth.covariance_enu_m2;
  PositionError result;
  result.horizontal_m = error_m.head<2>().norm();
  const Vector2 direction =
      result.horizontal_m > 0.0 ? Vector2(error_m.head<2>() / result.horizontal_m) : Vector2(1, 0);
  result.horizontal_3sigma_m = 3.0 * std::sqrt(direction.dot(covariance_m2.topLeftCorner<2, 2>() * direction));
  result.nees = error_m.dot(covariance_m2.llt().solve(error_m)) / 3.0;
  return result;
}

std::string enduranceCsvHeader() {
  return "wall_s,driven_h,rss_kb,latency_p50_ms,latency_p99_ms,horizontal_error_m,horizontal_3sigma_m,position_nees,"
         "stops\n";
}

std::string enduranceCsv(const EnduranceRow& row) {
  std::ostringstream line;
  line << std::fixed << std::setprecision(1) << row.wall_s << ',' << std::setprecision(4) << row.driven_h << ','
       << std::setprecision(0) << row.rss_kb << ',' << std::setprecision(3) << row.latency_p50_ms << ','
       << row.latency_p99_ms << ',' << row.error.horizontal_m << ',' << row.error.horizontal_3sigma_m << ','
       << row.error.nees << ',' << row.stops << '\n';
  return line.str();
}

EnduranceFigures enduranceFigures(const std::vector<EnduranceRow>& rows) {
  const auto begin = std::find_if(rows.begin(), rows.end(),
                                  [](const EnduranceRow& row) { return row.driven_h >= kEnduranceSettling_h; });
  const auto end = rows.end();
  if (std::distance(begin, end) < 2) {
    throw std::invalid_argument("the drive ended before memory had settled");
  }
  EnduranceFigures figures;
  figures.memory_growth_mb = (std::prev(end)->rss_kb - begin->rss_kb) / 1024.0;
  figures.latency_p50_ms = trendOf(begin, end, &EnduranceRow::latency_p50_ms);
  figures.latency_p99_ms = trendOf(begin, end, &EnduranceRow::latency_p99_ms);
  double covered = 0.0;
  double nees = 0.0;
  for (const EnduranceRow& row : rows) {
    covered += row.error.horizontal_m <= row.error.horizontal_3sigma_m ? 1.0 : 0.0;
    nees += row.error.nees;
  }
  figures.covered_pct = 100.0 * covered / static_cast<double>(rows.size());
  figures.nees_mean = nees / static_cast<double>(rows.size());
  return figures;
}

}  // namespace slipnav
