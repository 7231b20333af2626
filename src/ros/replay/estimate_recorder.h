#pragma once
/// Reassembles the messages of an estimator into the track that the evaluation uses.

#include <nav_msgs/Odometry.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>

#include <algorithm>
#include <map>

#include "evaluation/estimate.h"

namespace slipnav {

/// Joins odometry, nav_state and slip by their stamps.
class EstimateRecorder {
 public:
  /// A message older than the newest by a second or more starts a new track.
  void add(const nav_msgs::Odometry& message);
  void add(const NavState& message);
  void add(const Slip& message);

  std::size_t size() const { return estimates_.size(); }
  /// Stamp up to which both odometry and nav_state have arrived; each takes its own route.
  Nanoseconds newestStamp() const {
    return estimates_.empty() || stationary_.empty()
               ? 0
               : std::min(estimates_.rbegin()->first, stationary_.rbegin()->first);
  }

  EstimateTrack track() const;

 private:
  template <class Value>
  static void insert(Nanoseconds stamp, const Value& value, std::map<Nanoseconds, Value>& values);

  std::map<Nanoseconds, EstimateSample> estimates_;
  std::map<Nanoseconds, bool> stationary_;
  std::map<Nanoseconds, double> slip_;  ///< NaN where undefined
};

}  // namespace slipnav
