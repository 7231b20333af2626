#pragma once
/// Evaluation of a simulated drive through the nodelets.

#include <nav_msgs/Odometry.h>
#include <slipnav/Initialization.h>
#include <slipnav/NavState.h>
#include <slipnav/Slip.h>
#include <slipnav/StopStatus.h>

#include <string>

#include "simulation/simulator.h"

namespace slipnav {

/// Receives the drive and the nodelets' outputs. Messages that a judge does not need may be withheld from it.
class DriveEvaluator {
 public:
  virtual ~DriveEvaluator() = default;

  /// One interval, before its samples are published.
  virtual void add(const sim::Measurements& measurements, const sim::TruthState& truth) = 0;
  virtual void add(const nav_msgs::Odometry& message) = 0;
  virtual void add(const NavState&) {}
  virtual void add(const Slip&) {}
  virtual void add(const StopStatus&) {}
  virtual void add(const Initialization&) {}

  /// Stamp up to which it has the estimates.
  virtual Nanoseconds newestStamp() const = 0;
  /// The drive may end before its script does.
  virtual bool hasSeenEnough() const { return false; }
  /// Called once, at the end. @return its result as text
  virtual std::string verdict() = 0;
};

}  // namespace slipnav
