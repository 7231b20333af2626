#include "inspection/clock_offset.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/square.h"
#include "inspection/fine_offset.h"

namespace slipnav {
namespace {

constexpr double kStep_s = 0.1;
constexpr int kLargestShift = 300;  // steps
/// Slower changes (slopes, biases) are removed.
constexpr int kHighPass = 50;  // steps
constexpr double kLeastCorrelation = 0.4;
/// Shifts closer than this to the best one belong to its peak.
constexpr int kPeak = 15;  // steps
/// The next peak must be lower by this factor: regular stops repeat themselves.
constexpr double kClearly = 0.85;
constexpr std::size_t kLeastSamples = 200;
/// What the estimator allows for anyway is not worth a word.
constexpr double kWorthSaying_s = 0.02;
constexpr double kSigmas = 3.0;

using Signal = std::vector<double>;

/// Subtracts a running mean.
Signal highPass(const Signal& signal) {
  Signal sums(1, 0.0);
  for (const double value : signal) {
    sums.push_back(sums.back() + value);
  }
  Signal result(signal.size());
  const int size = static_cast<int>(signal.size());
  for (int i = 0; i < size; ++i) {
    const int begin = std::max(i - kHighPass / 2, 0);
    const int end = std::min(i + kHighPass / 2 + 1, size);
    const double mean = (sums[static_cast<std::size_t>(end)] - sums[static_cast<std::size_t>(begin)]) / (end - begin);
    result[static_cast<std::size_t>(i)] = signal[static_cast<std::size_t>(i)] - mean;
  }
  return result;
}

/// Normalized by the energy where both have samples. @param shift of b in steps
double correlation(const Signal& a, const Signal& b, int shift) {
  double product = 0.0;
  double energy_a = 0.0;
  double energy_b = 0.0;
  const int size = static_cast<int>(std::min(a.size(), b.size()));
  for (int i = std::max(0, -shift); i < std::min(size, size - shift); ++i) {
    const double x = a[static_cast<std::size_t>(i)];
    const int j = i + shift;
    const double y = b[static_cast<std::size_t>(j)];
    product += x * y;
    energy_a += x * x;
    energy_b += y * y;
  }
  return energy_a > 0.0 && energy_b > 0.0 ? product / std::sqrt(energy_a * energy_b) : 0.0;
}

/// The wheels' signal against one or two of the IMU's, in either direction.
class Shifts {
 public:
  Shifts(const std::vector<Signal>& imu, const Signal& wheels) {
    for (int shift = -kLargestShift; shift <= kLargestShift; ++shift) {
      double square_sum = 0.0;
      for (const Signal& signal : imu) {
        square_sum += square(correlation(signal, wheels, shift));
      }
      values_.push_back(std::sqrt(square_sum));
    }
  }

  ClockOffset best() const {
    const auto peak = std::max_element(values_.begin(), values_.end()) - values_.begin();
    ClockOffset offset;
    offset.correlation = values_[static_cast<std::size_t>(peak)];
    double next = 0.0;
    for (int i = 0; i < static_cast<int>(values_.size()); ++i) {
      if (std::abs(i - static_cast<int>(peak)) > kPeak) {
        next = std::max(next, values_[static_cast<std::size_t>(i)]);
      }
    }
    offset.known = offset.correlation > kLeastCorrelation && next < kClearly * offset.correlation;
    offset.wheels_ahead_s =
        kStep_s * (static_cast<double>(peak) - kLargestShift + vertex(static_cast<std::size_t>(peak)));
    return offset;
  }

 private:
  /// Of the parabola through the peak and its neighbors, from the peak.
  double vertex(std::size_t peak) const {
    if (peak == 0 || peak + 1 >= values_.size()) {
      return 0.0;
    }
    const double curvature = values_[peak - 1] - 2.0 * values_[peak] + values_[peak + 1];
    return curvature < 0.0 ? 0.5 * (values_[peak - 1] - values_[peak + 1]) / curvature : 0.0;
  }

  Signal values_;
};

struct Signals {
  Signal imu_turn;
  Signal imu_first;  ///< two components of the specific force across up
  Signal imu_second;
  Signal wheel_turn;
  Signal wheel_acceleration;
};

Signals sample(const ImuTrack& imu, const WheelTrack& wheels, const Vector3& up) {
  const Vector3 other = std::abs(up.x()) < 0.7 ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 first = (other - up * up.dot(other)).normalized();
  const Vector3 second = up.cross(first);
  const WheelInterpolation interpolation(wheels);
  Signals signals;
  const double end_s = std::min(imu.end(), imu.begin() + kLongestDrive_s);
  for (double t_s = imu.begin(); t_s < end_s; t_s += kStep_s) {
    const Vector3 force = imu.meanForce(t_s - 2.0 * kStep_s, t_s + 2.0 * kStep_s);
    signals.imu_turn.push_back(up.dot(imu.meanRate(t_s - kStep_s, t_s + kStep_s)));
    signals.imu_first.push_back(first.dot(force));
    signals.imu_second.push_back(second.dot(force));
    const auto before = interpolation.at(t_s - 2.0 * kStep_s);
    const auto row = interpolation.at(t_s);
    const auto after = interpolation.at(t_s + 2.0 * kStep_s);
    signals.wheel_turn.push_back(row ? row->turn : 0.0);
    signals.wheel_acceleration.push_back(before && after ? after->speed - before->speed : 0.0);
  }
  return signals;
}

/// By turns where the wheels tell them.
ClockOffset roughOffset(const Signals& signals, bool has_turn) {
  if (has_turn) {
    ClockOffset by_turns = Shifts({highPass(signals.imu_turn)}, highPass(signals.wheel_turn)).best();
    by_turns.by_turns = true;
    if (by_turns.known) {
      return by_turns;
    }
  }
  return Shifts({highPass(signals.imu_first), highPass(signals.imu_second)}, highPass(signals.wheel_acceleration))
      .best();
}

}  // namespace

bool ClockOffset::isBeyond(double offset_s) const {
  return known && std::abs(wheels_ahead_s - offset_s) > std::max(kSigmas * std_s, kWorthSaying_s);
}

ClockOffset correlateClocks(const ImuTrack& imu, const WheelTrack& wheels, const Vector3& up) {
  const Signals signals = sample(imu, wheels, up);
  if (signals.imu_turn.size() < kLeastSamples) {
    return {};
  }
  ClockOffset offset = roughOffset(signals, wheels.has_turn);
  if (offset.known) {
    if (const auto fine = fineOffset(imu, wheels, up, offset.wheels_ahead_s, offset.by_turns)) {
      offset.wheels_ahead_s = fine->wheels_ahead_s;
      offset.std_s = fine->std_s;
    }
  }
  return offset;
}

}  // namespace slipnav
