#include "inspection/motion_table.h"

#include <algorithm>
#include <cmath>

#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

/// Long enough to average vibration, short enough to see a start.
constexpr double kWindow_s = 0.6;
constexpr double kStep_s = 0.3;
/// Gravity propagated by gyros of any grade stays good for this long.
constexpr double kBatch_s = 4.8;
constexpr double kLongestGap_s = 1.0;

/// Residual gyro bias where no rest determines it: a vehicle does not keep tilting.
Vector3 biasOf(const ImuTrack& imu, const RestPicture& rest) {
  if (rest.known) {
    return rest.rate;
  }
  const Vector3 up = rest.force.normalized();
  const Vector3 mean = imu.meanRate(imu.begin() - 1.0, imu.end());
  return mean - up * up.dot(mean);
}

/// Gravity in the sensor's axes, as rotated by the gyros.
class CarriedGravity {
 public:
  CarriedGravity(const ImuTrack& imu, const RestPicture& rest, const Vector3& bias)
      : imu_(imu), bias_(bias), start_(rest.force) {}

  void restart(double time_s) {
    next_ = imu_.firstAfter(time_s);
    gravity_ = start_;
    sums_.assign(1, Vector3::Zero());
    first_ = next_;
  }
  /// Mean over (from, to] of the current batch.
  Vector3 mean(double from_s, double to_s) {
    const std::size_t begin = std::max(imu_.firstAfter(from_s), first_);
    const std::size_t end = imu_.firstAfter(to_s);
    carryTo(end);
    return end > begin ? Vector3((sums_[end - first_] - sums_[begin - first_]) / static_cast<double>(end - begin))
                       : start_;
  }

 private:
  void carryTo(std::size_t end) {
    for (; next_ < end; ++next_) {
      const double dt_s = next_ == 0 ? 0.0 : std::min(imu_.times()[next_] - imu_.times()[next_ - 1], kLongestGap_s);
      gravity_ = quaternionFromRotationVector(-dt_s * (imu_.rate(next_) - bias_)) * gravity_;
      sums_.push_back(sums_.back() + gravity_);
    }
  }

  const ImuTrack& imu_;
  Vector3 bias_;
  Vector3 start_;
  Vector3 gravity_ = Vector3::Zero();
  std::size_t first_ = 0;
  std::size_t next_ = 0;
  std::vector<Vector3> sums_;
};

/// Subtracts the mean over each batch from acceleration and force: residual gravity and bias.
void center(std::vector<MotionRow>& rows) {
  for (std::size_t begin = 0; begin < rows.size();) {
    std::size_t end = begin;
    MotionRow sum;
    while (end < rows.size() && rows[end].batch == rows[begin].batch) {
      sum.acceleration += rows[end].acceleration;
      sum.force += rows[end].force;
      ++end;
    }
    const double count = static_cast<double>(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      rows[i].acceleration -= sum.acceleration / count;
      rows[i].force -= sum.force / count;
    }
    begin = end;
  }
}

}  // namespace

std::optional<WheelRow> WheelInterpolation::at(double time_s) const {
  const auto after = std::upper_bound(wheels_.rows.begin(), wheels_.rows.end(), time_s,
                                      [](double t, const WheelRow& row) { return t < row.time_s; });
  if (after == wheels_.rows.begin() || after == wheels_.rows.end() ||
      after->time_s - std::prev(after)->time_s > kLongestGap_s) {
    return std::nullopt;
  }
  const WheelRow& before = *std::prev(after);
  const double share = (time_s - before.time_s) / (after->time_s - before.time_s);
  WheelRow row = before;
  row.time_s = time_s;
  row.speed += share * (after->speed - before.speed);
  row.turn += share * (after->turn - before.turn);
  return row;
}

MotionTable motionTable(const ImuTrack& imu, const WheelTrack& wheels, const RestPicture& rest, double wheels_ahead_s) {
  MotionTable table;
  const Vector3 bias = biasOf(imu, rest);
  CarriedGravity gravity(imu, rest, bias);
  const WheelInterpolation interpolation(wheels);
  const double end_s = std::min(imu.end(), imu.begin() + kLongestDrive_s);
  std::size_t batch = 0;
  for (double start_s = imu.begin(); start_s + kBatch_s < end_s; start_s += kBatch_s, ++batch) {
    gravity.restart(start_s);
    for (double t_s = start_s + 0.5 * kWindow_s; t_s + 0.5 * kWindow_s <= start_s + kBatch_s + 1e-9; t_s += kStep_s) {
      const double from_s = t_s - 0.5 * kWindow_s;
      const double to_s = t_s + 0.5 * kWindow_s;
      const auto before = interpolation.at(from_s + wheels_ahead_s);
      const auto middle = interpolation.at(t_s + wheels_ahead_s);
      const auto after = interpolation.at(to_s + wheels_ahead_s);
      if (!before || !middle || !after || imu.firstAfter(to_s) == imu.firstAfter(from_s)) {
        continue;
      }
      table.rows.push_back({t_s, batch, middle->speed, (after->speed - before->speed) / kWindow_s, middle->turn,
                            imu.meanForce(from_s, to_s) - gravity.mean(from_s, to_s),
                            imu.meanRate(from_s, to_s) - bias});
    }
  }
  center(table.rows);
  return table;
}

}  // namespace slipnav
