#pragma once
/// Ordered reference positions, from satellites, motion capture or a simulator.

#include <optional>
#include <vector>

#include "slipnav/core/base/sensors.h"
#include "slipnav/core/base/types.h"
#include "slipnav/core/earth/local_frame.h"

namespace slipnav {

/// The true pose at one instant, in the map frame or in the truth's own frame.
struct TruthSample {
  Nanoseconds stamp = 0;
  Vector3 position_enu_m = Vector3::Zero();
  std::optional<Quaternion> q_flu_to_enu = std::nullopt;  ///< attitude, if the truth has one
  Matrix3 covariance_enu_m2 = Matrix3::Zero();            ///< of the position, zero if unknown or exact
};

/// Samples in order of stamp, with interpolation between neighbors.
class TruthTrack {
 public:
  /// Longest interval between neighbors that is interpolated [s].
  static constexpr double kMaxGapS = 1.5;

  TruthTrack() = default;
  /// Sorts by stamp; of samples with equal stamps the first is kept. Throws std::invalid_argument for positions that
  /// are not finite and for a gap that is not positive.
  explicit TruthTrack(std::vector<TruthSample> samples, double max_gap_s = kMaxGapS);

  /// Satellite fixes (positions of the antenna) in the local frame of the estimator.
  static TruthTrack fromFixes(const std::vector<GnssFix>& fixes, const LocalFrame& frame, double max_gap_s = kMaxGapS);

  bool empty() const { return samples_.empty(); }
  const std::vector<TruthSample>& samples() const { return samples_; }
  double maxGap() const { return max_gap_s_; }  ///< [s]

  /// Truth at `stamp`: position and covariance linear, attitude by slerp if both neighbors have one. None outside
  /// the track and inside gaps longer than maxGap().
  std::optional<TruthSample> at(Nanoseconds stamp) const;

 private:
  std::vector<TruthSample> samples_;
  double max_gap_s_ = kMaxGapS;
};

}  // namespace slipnav
