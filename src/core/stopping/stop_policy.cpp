#include "core/stopping/stop_policy.h"

#include <cmath>
#include <stdexcept>

namespace slipnav {
namespace {

/// Number that fills all of `text`.
double parseSeconds(const std::string& text, const std::string& whole) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !std::isfinite(value)) {
    throw std::invalid_argument("policy '" + whole + "': '" + text + "' is not a number of seconds");
  }
  return value;
}

StopParams activated(StopParams params) {
  params.mode = "active";
  return params;
}

}  // namespace

PeriodicStops::PeriodicStops(double every_s, double hold_s) : every_s_(every_s), hold_s_(hold_s) {
  if (!(every_s > 0.0) || !(hold_s > 0.0)) {
    throw std::invalid_argument("periodic stops need a drive and a hold longer than zero seconds");
  }
}

VelocityCommand PeriodicStops::command(const VelocityCommand& in, const DriveMoment& moment) {
  return moment.on_route && hold(moment) ? VelocityCommand{} : in;
}

bool PeriodicStops::hold(const DriveMoment& moment) {
  if (driving_since_ == 0) {
    driving_since_ = moment.stamp;
  }
  if (!holding_) {
    holding_ = toSeconds(moment.stamp - driving_since_) >= every_s_;
    standing_since_ = 0;
    return holding_;
  }
  if (!moment.standstill) {
    return true;
  }
  if (standing_since_ == 0) {
    standing_since_ = moment.stamp;
  }
  if (toSeconds(moment.stamp - standing_since_) >= hold_s_) {
    holding_ = false;
    driving_since_ = moment.stamp;
  }
  return holding_;
}

AutonomousStops::AutonomousStops(const StopParams& params) : supervisor_(activated(params)) {}

std::unique_ptr<StopPolicy> makeStopPolicy(const std::string& text, const StopParams& params) {
  if (text == "none") {
    return std::make_unique<NeverStop>();
  }
  if (text == "autonomous") {
    return std::make_unique<AutonomousStops>(params);
  }
  const std::string kPeriodic = "periodic:";
  const std::size_t colon = text.find(':', kPeriodic.size());
  if (text.compare(0, kPeriodic.size(), kPeriodic) == 0 && colon != std::string::npos) {
    return std::make_unique<PeriodicStops>(parseSeconds(text.substr(kPeriodic.size(), colon - kPeriodic.size()), text),
                                           parseSeconds(text.substr(colon + 1), text));
  }
  throw std::invalid_argument("policy '" + text + "' is not known (none, periodic:EVERY_S:HOLD_S, autonomous)");
}

}  // namespace slipnav
