#include "tuning/knob.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "config/tuning.h"
#include "core/base/text.h"

namespace slipnav {
namespace {

/// A configured deviation is off by a factor of three, as assumed by the filter's own learning.
const double kPriorStd = std::log(3.0);
/// Beyond a factor of ten something other than noise is wrong.
const double kLargestFactor = std::log(10.0);
/// Clocks of hosts and drivers [s]; more than this is not a delay but another clock.
constexpr double kDelayStd_s = 0.05;
constexpr double kLargestDelay_s = 0.25;

struct Offer {
  const char* name;
  std::vector<std::string> keys;
  bool has_floor;
};

const std::vector<Offer>& offers() {
  static const std::vector<Offer> kOffers = {
      {"noise of the accelerometers", {"imu.noise.accel_noise_mps_per_sqrt_h"}, true},
      {"noise of the gyros", {"imu.noise.gyro_noise_deg_per_sqrt_h"}, true},
      {"bias of the accelerometers", {"imu.noise.accel_bias_std_ug"}, true},
      {"noise of the wheel speed", {"wheel.speed_std_mps"}, false},
      {"jitter of the wheels' stamps", {"wheel.stamp_std_s"}, false},
      {"fast slip", {"vehicle.fast_slip_std", "wheel.slip_noise_std"}, true},
      {"length of fast slip", {"vehicle.fast_slip_length_m"}, false},
      {"persistent slip", {"vehicle.slow_slip_std"}, false},
      {"length of persistent slip", {"vehicle.slow_slip_length_m"}, false},
      {"side slip", {"vehicle.side_slip_std_deg"}, false},
      {"sway",
       {"nonholonomic.lateral_std_mps", "nonholonomic.lateral_slope_std", "nonholonomic.lateral_turn_std_m"},
       true},
      {"heave and pitch",
       {"nonholonomic.vertical_std_mps", "nonholonomic.vertical_slope_std", "nonholonomic.vertical_turn_std_m"},
       true},
  };
  return kOffers;
}

using Parameters = std::map<std::string, ParameterInfo>;

Parameters parametersOf(const Config& config) {
  Parameters parameters;
  for (ParameterInfo& info : listParameters(config)) {
    parameters.emplace(info.key, info);
  }
  return parameters;
}

Knob factorKnob(const Offer& offer, const Parameters& parameters) {
  Knob knob{offer.name, {}, true, kPriorStd, offer.has_floor ? 0.0 : -kLargestFactor, kLargestFactor};
  for (const std::string& key : offer.keys) {
    const ParameterInfo& info = parameters.at(key);
    const double value = std::get<double>(info.value);
    if (value > 0.0) {
      knob.keys.push_back(key);
      knob.upper = std::min(knob.upper, std::log(info.range.max / value));
      knob.lower = std::max(knob.lower, info.range.min > 0.0 ? std::log(info.range.min / value) : knob.lower);
    }
  }
  return knob;
}

Knob delayKnob(const Parameters& parameters) {
  const ParameterInfo& info = parameters.at("wheel.stamp_delay_s");
  const double value = std::get<double>(info.value);
  return {"delay of the wheels' stamps",
          {info.key},
          false,
          kDelayStd_s,
          std::max(-kLargestDelay_s, info.range.min - value),
          std::min(kLargestDelay_s, info.range.max - value)};
}

std::vector<Knob> knobsWith(const std::vector<std::string>& keys, const std::vector<Knob>& all) {
  std::vector<std::string> known;
  for (const Knob& knob : all) {
    known.insert(known.end(), knob.keys.begin(), knob.keys.end());
  }
  std::vector<Knob> chosen;
  for (const Knob& knob : all) {
    if (std::any_of(knob.keys.begin(), knob.keys.end(), [&keys](const std::string& key) {
          return std::find(keys.begin(), keys.end(), key) != keys.end();
        })) {
      chosen.push_back(knob);
    }
  }
  for (const std::string& key : keys) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw std::invalid_argument("'" + key + "' cannot be tuned, did you mean '" + nearestName(key, known) + "'?");
    }
  }
  return chosen;
}

}  // namespace

std::vector<Knob> tuningKnobs(const Config& config, const std::vector<std::string>& only) {
  const Parameters parameters = parametersOf(config);
  std::vector<Knob> knobs = {delayKnob(parameters)};
  for (const Offer& offer : offers()) {
    Knob knob = factorKnob(offer, parameters);
    if (!knob.keys.empty()) {
      knobs.push_back(knob);
    }
  }
  return only.empty() ? knobs : knobsWith(only, knobs);
}

Config withKnobs(const Config& config, const std::vector<Knob>& knobs, const Eigen::VectorXd& position) {
  const Parameters parameters = parametersOf(config);
  std::vector<ParameterChange> changes;
  for (std::size_t i = 0; i < knobs.size(); ++i) {
    for (const std::string& key : knobs[i].keys) {
      const ParameterInfo& info = parameters.at(key);
      const double value = moved(knobs[i], std::get<double>(info.value), position(static_cast<Eigen::Index>(i)));
      changes.push_back({key, std::clamp(value, info.range.min, info.range.max)});
    }
  }
  return withChanges(config, changes);
}

double moved(const Knob& knob, double configured, double position) {
  return knob.is_factor ? configured * std::exp(position) : configured + position;
}

}  // namespace slipnav
