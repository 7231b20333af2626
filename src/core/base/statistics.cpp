#include "core/base/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace slipnav {
namespace {

void requireSome(const std::vector<double>& values) {
  if (values.empty()) {
    throw std::invalid_argument("statistics of an empty sample");
  }
}

double sumOfSquares(const std::vector<double>& values, double center) {
  double sum = 0.0;
  for (const double value : values) {
    sum += (value - center) * (value - center);
  }
  return sum;
}

}  // namespace

double percentile(std::vector<double> values, double p) {
  requireSome(values);
  if (!(p >= 0.0 && p <= 100.0)) {
    throw std::invalid_argument("percentile " + std::to_string(p) + " is not in [0, 100]");
  }
  std::sort(values.begin(), values.end());
  const double rank = p / 100.0 * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (rank - static_cast<double>(below)) * (values[above] - values[below]);
}

double median(std::vector<double> values) { return percentile(std::move(values), 50.0); }

double mean(const std::vector<double>& values) {
  requireSome(values);
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

double standardDeviation(const std::vector<double>& values) {
  return std::sqrt(sumOfSquares(values, mean(values)) / static_cast<double>(values.size()));
}

double rootMeanSquare(const std::vector<double>& values) {
  requireSome(values);
  return std::sqrt(sumOfSquares(values, 0.0) / static_cast<double>(values.size()));
}

}  // namespace slipnav
