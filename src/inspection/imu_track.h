#pragma once
/// Samples of one IMU in regular time, and their means over any window.

#include <vector>

#include "inspection/recording.h"
#include "slipnav/core/ordering/imu_clock.h"

namespace slipnav {

/// In the sensor's own axes, at stamps as the estimator would correct them (ImuClock). Immutable.
class ImuTrack {
 public:
  ImuTrack(const ImuRecord& record, Nanoseconds origin);

  std::size_t size() const { return time_s_.size(); }
  double begin() const { return time_s_.empty() ? 0.0 : time_s_.front(); }  ///< [s] after the origin
  double end() const { return time_s_.empty() ? 0.0 : time_s_.back(); }
  const std::vector<double>& times() const { return time_s_; }
  const Vector3& force(std::size_t i) const { return force_[i]; }
  const Vector3& rate(std::size_t i) const { return rate_[i]; }
  const StampFaults& stampFaults() const { return faults_; }

  /// Index of the first sample later than `time_s`.
  std::size_t firstAfter(double time_s) const;
  /// Over the samples in (from, to]; zero if there is none.
  Vector3 meanForce(double from_s, double to_s) const { return mean(force_sum_, from_s, to_s); }
  Vector3 meanRate(double from_s, double to_s) const { return mean(rate_sum_, from_s, to_s); }

 private:
  void add(const ImuSample& sample);
  Vector3 mean(const std::vector<Vector3>& sums, double from_s, double to_s) const;

  std::vector<double> time_s_;
  std::vector<Vector3> force_;
  std::vector<Vector3> rate_;
  std::vector<Vector3> force_sum_ = {Vector3::Zero()};  ///< of all samples before
  std::vector<Vector3> rate_sum_ = {Vector3::Zero()};
  StampFaults faults_;
};

}  // namespace slipnav
