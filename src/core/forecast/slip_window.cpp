#include "core/forecast/slip_window.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace slipnav {
namespace {

double medianInterval(const std::vector<double>& times_s) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < times_s.size(); ++i) {
    intervals.push_back(times_s[i] - times_s[i - 1]);
  }
  if (intervals.empty()) {
    return 0.0;
  }
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

double meanSquare(const Eigen::VectorXd& values) { return values.squaredNorm() / static_cast<double>(values.size()); }

}  // namespace

SlipWindow makeSlipWindow(const SlipSamples& samples) {
  if (samples.times_s.size() != samples.slips.size()) {
    throw std::invalid_argument("slip window: times and slips must have the same length");
  }
  std::vector<double> times_s;
  std::vector<double> slips;
  for (std::size_t i = 0; i < samples.slips.size(); ++i) {
    const double time_s = samples.times_s[i];
    const bool later = times_s.empty() || time_s > times_s.back();
    if (std::isfinite(time_s) && later && std::abs(samples.slips[i]) < 1.0) {
      times_s.push_back(time_s);
      slips.push_back(samples.slips[i]);
    }
  }
  SlipWindow window;
  window.left_out = static_cast<int>(samples.slips.size() - slips.size());
  window.interval_s = medianInterval(times_s);
  window.origin_s = samples.origin_s.value_or(times_s.empty() ? 0.0 : times_s.front() - window.interval_s);
  const auto count = static_cast<Eigen::Index>(slips.size());
  window.times = Eigen::Map<const Eigen::VectorXd>(times_s.data(), count).array() - window.origin_s;
  window.slips = Eigen::Map<const Eigen::VectorXd>(slips.data(), count);
  return window;
}

WindowScale measureScale(const SlipWindow& window, double slip_floor) {
  const Eigen::Index count = window.size();
  if (count < 2) {
    throw std::invalid_argument("slip window: a scale needs at least two samples");
  }
  const double floor_power = slip_floor * slip_floor;
  const Eigen::VectorXd centered = window.slips.array() - window.slips.mean();
  const Eigen::VectorXd differences = window.slips.tail(count - 1) - window.slips.head(count - 1);
  WindowScale scale;
  scale.interval_s = window.interval_s;
  scale.span_s = window.times(count - 1) - window.times(0);
  scale.mean_time_s = window.times.mean();
  scale.count = count;
  scale.power = std::max(floor_power, meanSquare(window.slips));
  scale.variance = std::max(floor_power, meanSquare(centered));
  scale.difference_power = std::max(floor_power, 0.5 * meanSquare(differences));
  return scale;
}

bool isConstant(const SlipWindow& window, double slip_floor) {
  return window.size() > 0 && window.slips.maxCoeff() - window.slips.minCoeff() < slip_floor;
}

}  // namespace slipnav
