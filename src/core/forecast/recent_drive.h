#pragma once
/// What was driven last: attitudes and speeds by interval, slip by distance.
///
/// Ground changes over distance, so the slip window covers both a time and a distance. Each of its samples is the slip
/// of a piece of way, 1 − Σv/Σrω, so that a slow rover's samples are as few, and as good, as a fast one's.

#include <deque>
#include <optional>

#include "core/forecast/forecast_params.h"
#include "core/forecast/slip_window.h"
#include "slipnav/core/ekf/engine/filter_data.h"

namespace slipnav {

/// Takes the wheel intervals of free driving. Time at standstill does not count, except that slip from before a long
/// one is dropped.
class RecentDrive {
 public:
  /// @param all also the wheel speeds that the filter does not use, which are slip impulses unless it uses none
  RecentDrive(const ForecastParams& params, bool all) : params_(params), all_(all) {}

  /// Other lengths from the next interval on.
  void retune(const ForecastParams& params, bool all);
  void reset();

  /// @param estimate of a moving rover, with wheels
  void add(const Estimate& estimate);

  /// Number of wheel intervals kept.
  std::size_t intervals() const { return intervals_.size(); }

  /// The window, times in seconds since `origin()`.
  SlipSamples slip() const;
  /// Stamp of the first slip sample; of the newest interval if there is none.
  Nanoseconds origin() const { return slips_.empty() ? newest_ : slips_.front().stamp; }
  /// Number of wheel intervals that one slip sample covers, mean.
  double intervalsPerSlip() const;

  /// Mean slip of the newest `way_m` of driving; nothing if less was driven after `since`.
  std::optional<double> meanSlip(double way_m, Nanoseconds since) const;

  // The others need at least one interval.

  /// Mean of the newest forward speeds, without starts and stops [m/s].
  double cruisingSpeed() const;
  /// Share of the wheel speeds that the filter used.
  double wheelShare() const;
  /// Attitude that number of intervals ago; farther back than they reach it moves forward again, and so on.
  const Quaternion& attitude(std::size_t back) const;

 private:
  struct Interval {
    double speed_mps = 0.0;
    bool wheel_speed_used = true;
    Quaternion q_b_to_n = Quaternion::Identity();
  };
  struct Slip {
    Nanoseconds stamp = 0;
    double slip = 0.0;
    double driven_s = 0.0;  ///< since the first interval, at its end
    double intervals = 0.0;
    double way_m = 0.0;
  };
  /// A sample in the making.
  struct Piece {
    double way_m = 0.0;
    double wheel_way_m = 0.0;
    double duration_s = 0.0;
    double intervals = 0.0;
  };

  void lengthen(const BodyMotion& motion, double wheel_speed_mps);
  void close(Nanoseconds stamp);

  ForecastParams params_;
  bool all_;
  std::deque<Interval> intervals_;
  std::deque<Slip> slips_;
  Piece piece_;
  double driven_s_ = 0.0;
  Nanoseconds newest_ = 0;
};

}  // namespace slipnav
