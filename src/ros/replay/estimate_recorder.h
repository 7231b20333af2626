#pragma once
/// Reassembles the messages of an estimator into the track that the evaluation uses.

#include <nav_msgs/Odometry.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>

#include <algorithm>
#include <map>

#include "core/ordering/continuous_time.h"
#include "evaluation/estimate.h"

namespace slipnav {

/// Joins odometry, nav_state and slip by their stamps.
class EstimateRecorder {
 public:
  /// Stamps go on where the clock is set back, as in the estimator; a recording that is played again starts a new
  /// track.
  void add(const nav_msgs::Odometry& message);
  void add(const NavState& message);
  void add(const Slip& message);

  std::size_t size() const { return estimates_.values.size(); }
  /// Stamp up to which both odometry and nav_state have arrived; each takes its own route.
  Nanoseconds newestStamp() const {
    return estimates_.values.empty() || stationary_.values.empty()
               ? 0
               : std::min(estimates_.values.rbegin()->first, stationary_.values.rbegin()->first);
  }

  EstimateTrack track() const;

 private:
  /// One kind of message, by stamps in continuous time.
  template <class Value>
  struct Stream {
    void insert(Nanoseconds stamp, const Value& value);

    ContinuousTime time;
    std::map<Nanoseconds, Value> values;
  };

  Stream<EstimateSample> estimates_;
  Stream<bool> stationary_;
  Stream<double> slip_;  ///< NaN where undefined
};

}  // namespace slipnav
