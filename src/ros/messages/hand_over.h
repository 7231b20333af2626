#pragma once
/// What Filter hands over once a second, so that the estimate can continue without it.

#include <ros/node_handle.h>
#include <slipnav/StartState.h>

#include <boost/shared_ptr.hpp>

#include "ros/runtime/shared_publisher.h"
#include "slipnav/core/ekf/engine/filter_engine.h"

namespace slipnav {

/// Publisher of `hand_over`, latched.
class HandOver {
 public:
  explicit HandOver(ros::NodeHandle& node);

  /// An estimate has started from this message; its first state is due immediately.
  void start(const StartState& message, const Geodetic& origin);
  /// The state of the filter, if it is due.
  void offer(const FilterEngine& filter);
  /// There is no longer an estimate.
  /// @param start that ended it
  void end(std::uint32_t start);

 private:
  void publish(const boost::shared_ptr<StartState>& message) const;

  std::uint32_t start_ = 0;
  std::uint32_t session_ = 0;
  Geodetic origin_;
  Nanoseconds last_ = 0;
  SharedPublisher<StartState> publisher_;
};

}  // namespace slipnav
