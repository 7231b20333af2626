#pragma once
/// Who decides about stops in a simulated drive: nobody, a clock, or the stop supervisor.

#include <memory>
#include <string>

#include "core/stopping/stop_supervisor.h"

namespace slipnav {

/// What a clock-driven policy may know about the drive, at the start of a control interval.
struct DriveMoment {
  Nanoseconds stamp = 0;
  bool standstill = false;  ///< the rover stands
  bool on_route = false;    ///< the initialization drive is over
};

/// Stands between the simulated operator and the simulated rover.
class StopPolicy {
 public:
  virtual ~StopPolicy() = default;

  /// Asked once per control interval, with stamps in ascending order.
  /// @param in the operator's command
  /// @return the command given to the rover instead
  virtual VelocityCommand command(const VelocityCommand& in, const DriveMoment& moment) = 0;

  /// Each estimate of the navigation, in order.
  virtual void observe(const RoverObservation&) {}
  /// Each forecast, after the estimate it was made with.
  virtual void setForecast(const StopForecast&) {}
};

/// Always drives on.
class NeverStop : public StopPolicy {
 public:
  VelocityCommand command(const VelocityCommand& in, const DriveMoment&) override { return in; }
};

/// Drives for `every_s`, stops, stands for `hold_s`, and so on (Kilic et al. 2019), from the start of the route.
class PeriodicStops : public StopPolicy {
 public:
  /// Throws std::invalid_argument unless both are above zero.
  PeriodicStops(double every_s, double hold_s);
  VelocityCommand command(const VelocityCommand& in, const DriveMoment& moment) override;

 private:
  bool hold(const DriveMoment& moment);

  double every_s_;
  double hold_s_;
  Nanoseconds driving_since_ = 0;
  Nanoseconds standing_since_ = 0;
  bool holding_ = false;
};

/// The stop supervisor in the mode `active`, whatever the parameters say.
class AutonomousStops : public StopPolicy {
 public:
  explicit AutonomousStops(const StopParams& params);

  VelocityCommand command(const VelocityCommand& in, const DriveMoment&) override { return supervisor_.command(in); }
  void observe(const RoverObservation& observation) override { supervisor_.observe(observation); }
  void setForecast(const StopForecast& forecast) override { supervisor_.setForecast(forecast); }

 private:
  StopSupervisor supervisor_;
};

/// Policy by its name on the command line: `none`, `periodic:EVERY_S:HOLD_S` or `autonomous`.
/// Throws std::invalid_argument that names anything else.
std::unique_ptr<StopPolicy> makeStopPolicy(const std::string& text, const StopParams& params);

}  // namespace slipnav
