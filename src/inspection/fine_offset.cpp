#include "inspection/fine_offset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/square.h"

namespace slipnav {
namespace {

constexpr double kStep_s = 0.01;
constexpr int kShifts = 25;  // to either side
/// Points of the parabola to either side of the maximum.
constexpr int kParabola = 5;
constexpr std::size_t kTenths = 10;
constexpr std::size_t kLeastRows = 200;
/// An hour at 10 Hz says enough.
constexpr std::size_t kMostRows = 36000;
/// Slower changes (slopes, biases) are removed.
constexpr double kHighPass_s = 5.0;
/// Wheels farther apart have a gap between them.
constexpr double kLongestInterval_s = 1.0;

using Signal = std::vector<double>;

/// A signal of the IMU whose samples are means over the interval before them.
class Integral {
 public:
  template <class SampleOf>
  Integral(const ImuTrack& imu, SampleOf sample_of) : imu_(imu) {
    sums_.reserve(imu.size());
    for (std::size_t i = 0; i < imu.size(); ++i) {
      const double interval_s = i == 0 ? 0.0 : imu.times()[i] - imu.times()[i - 1];
      samples_.push_back(sample_of(i));
      sums_.push_back((i == 0 ? 0.0 : sums_.back()) + interval_s * samples_.back());
    }
  }

  double mean(double from_s, double to_s) const { return (until(to_s) - until(from_s)) / (to_s - from_s); }

 private:
  double until(double time_s) const {
    const std::size_t next = imu_.firstAfter(time_s);
    if (next == 0) {
      return 0.0;
    }
    return next == imu_.size() ? sums_.back() : sums_[next - 1] + (time_s - imu_.times()[next - 1]) * samples_[next];
  }

  const ImuTrack& imu_;
  Signal samples_;
  Signal sums_;
};

/// What the wheels say of an interval.
struct Interval {
  double begin_s = 0.0;
  double end_s = 0.0;
  double value = 0.0;
};

std::vector<Interval> turnsOf(const WheelTrack& wheels) {
  std::vector<Interval> intervals;
  for (const WheelRow& row : wheels.rows) {
    intervals.push_back({row.time_s - 0.5 * row.interval_s, row.time_s + 0.5 * row.interval_s, row.turn});
  }
  return intervals;
}

std::vector<Interval> accelerationsOf(const WheelTrack& wheels) {
  std::vector<Interval> intervals;
  for (std::size_t i = 2; i < wheels.rows.size(); ++i) {
    const WheelRow& before = wheels.rows[i - 2];
    const WheelRow& after = wheels.rows[i];
    if (after.time_s - before.time_s < 2.0 * kLongestInterval_s) {
      intervals.push_back({before.time_s, after.time_s, (after.speed - before.speed) / (after.time_s - before.time_s)});
    }
  }
  return intervals;
}

/// Without the mean over some seconds around each.
Signal highPass(const std::vector<Interval>& intervals, const Signal& values) {
  Signal result(values.size());
  std::size_t begin = 0;
  std::size_t end = 0;
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (; end < values.size() && intervals[end].begin_s < intervals[i].begin_s + 0.5 * kHighPass_s; ++end) {
      sum += values[end];
    }
    for (; intervals[begin].begin_s < intervals[i].begin_s - 0.5 * kHighPass_s; ++begin) {
      sum -= values[begin];
    }
    result[i] = values[i] - sum / static_cast<double>(end - begin);
  }
  return result;
}

/// Σ of the products of one shift over one tenth of the drive.
struct Products {
  double imu_wheels = 0.0;
  double imu = 0.0;
  double wheels = 0.0;
  Products& operator+=(const Products& other) {
    imu_wheels += other.imu_wheels;
    imu += other.imu;
    wheels += other.wheels;
    return *this;
  }
};

using ByTenth = std::array<Products, kTenths>;

ByTenth productsOf(const std::vector<Interval>& intervals, const Signal& wheels, const Integral& imu, double shift_s) {
  Signal values;
  values.reserve(intervals.size());
  for (const Interval& interval : intervals) {
    values.push_back(imu.mean(interval.begin_s - shift_s, interval.end_s - shift_s));
  }
  values = highPass(intervals, values);
  ByTenth tenths;
  for (std::size_t i = 0; i < values.size(); ++i) {
    tenths[i * kTenths / values.size()] += {values[i] * wheels[i], square(values[i]), square(wheels[i])};
  }
  return tenths;
}

/// Squared correlation of each shift with each signal of the IMU, by tenth of the drive.
class ShiftTable {
 public:
  void add(const std::vector<Interval>& intervals, const Integral& imu, double roughly_s) {
    Signal wheels;
    for (const Interval& interval : intervals) {
      wheels.push_back(interval.value);
    }
    wheels = highPass(intervals, wheels);
    signals_.emplace_back();
    for (int shift = -kShifts; shift <= kShifts; ++shift) {
      signals_.back().push_back(productsOf(intervals, wheels, imu, roughly_s + shift * kStep_s));
    }
  }

  /// Shift of the maximum in seconds; nothing at the edges. @param left_out a tenth, or kTenths for none
  std::optional<double> maximum(std::size_t left_out) const {
    Signal values;
    for (int shift = 0; shift <= 2 * kShifts; ++shift) {
      values.push_back(squaredCorrelation(static_cast<std::size_t>(shift), left_out));
    }
    const int peak = static_cast<int>(std::max_element(values.begin(), values.end()) - values.begin());
    if (peak < kParabola || peak > 2 * kShifts - kParabola) {
      return std::nullopt;
    }
    const std::optional<double> vertex = vertexAround(values, peak);
    return vertex ? std::optional<double>(kStep_s * (peak - kShifts + *vertex)) : std::nullopt;
  }

 private:
  double squaredCorrelation(std::size_t shift, std::size_t left_out) const {
    double sum = 0.0;
    for (const std::vector<ByTenth>& signal : signals_) {
      Products all;
      for (std::size_t tenth = 0; tenth < kTenths; ++tenth) {
        all += tenth == left_out ? Products{} : signal[shift][tenth];
      }
      sum += all.imu * all.wheels > 0.0 ? square(all.imu_wheels) / (all.imu * all.wheels) : 0.0;
    }
    return sum;
  }

  /// Of the parabola by least squares, from the peak.
  static std::optional<double> vertexAround(const Signal& values, int peak) {
    double linear = 0.0;
    double squares = 0.0;
    double quadratic = 0.0;
    double fourth = 0.0;
    double mean = 0.0;
    constexpr double kPoints = 2.0 * kParabola + 1.0;
    const auto at_peak = values.begin() + peak;
    for (int i = -kParabola; i <= kParabola; ++i) {
      mean += at_peak[i] / kPoints;
      squares += i * i;
    }
    for (int i = -kParabola; i <= kParabola; ++i) {
      const double value = at_peak[i] - mean;
      const double bend = i * i - squares / kPoints;
      linear += i * value / squares;
      quadratic += bend * value;
      fourth += bend * bend;
    }
    const double curvature = quadratic / fourth;
    return curvature < 0.0 ? std::optional<double>(-0.5 * linear / curvature) : std::nullopt;
  }

  std::vector<std::vector<ByTenth>> signals_;
};

std::optional<double> scatterOf(const ShiftTable& table) {
  std::vector<double> offsets;
  double mean = 0.0;
  for (std::size_t tenth = 0; tenth < kTenths; ++tenth) {
    const std::optional<double> offset_s = table.maximum(tenth);
    if (!offset_s) {
      return std::nullopt;
    }
    offsets.push_back(*offset_s);
    mean += *offset_s / kTenths;
  }
  double sum = 0.0;
  for (const double offset_s : offsets) {
    sum += square(offset_s - mean);
  }
  return std::sqrt(sum * (kTenths - 1.0) / kTenths);
}

}  // namespace

std::optional<FineOffset> fineOffset(const ImuTrack& imu, const WheelTrack& wheels, const Vector3& up, double roughly_s,
                                     bool by_turns) {
  std::vector<Interval> intervals = by_turns ? turnsOf(wheels) : accelerationsOf(wheels);
  intervals.resize(std::min(intervals.size(), kMostRows));
  if (intervals.size() < kLeastRows) {
    return std::nullopt;
  }
  ShiftTable table;
  if (by_turns) {
    table.add(intervals, Integral(imu, [&](std::size_t i) { return up.dot(imu.rate(i)); }), roughly_s);
  } else {
    const Vector3 other = std::abs(up.x()) < 0.7 ? Vector3::UnitX() : Vector3::UnitY();
    const Vector3 first = (other - up * up.dot(other)).normalized();
    const Vector3 second = up.cross(first);
    for (const Vector3& axis : {first, second}) {
      table.add(intervals, Integral(imu, [&](std::size_t i) { return axis.dot(imu.force(i)); }), roughly_s);
    }
  }
  const std::optional<double> offset_s = table.maximum(kTenths);
  const std::optional<double> std_s = scatterOf(table);
  if (!offset_s || !std_s) {
    return std::nullopt;
  }
  return FineOffset{roughly_s + *offset_s, *std_s};
}

}  // namespace slipnav
