#pragma once
/// Noise, delay and slip of a robot from its own drives: maximum likelihood of the innovations, judged on held-out
/// data.

#include <array>
#include <optional>

#include "tuning/selection.h"

namespace slipnav {

/// Result for a knob.
struct TunedKnob {
  Knob knob;
  bool told = false;      ///< the drives determine it; otherwise it stays
  double position = 0.0;  ///< its new value, 0: as configured
  /// 1σ of the position, from the curvature of likelihood and prior and from the distance between the halves.
  std::optional<double> std;
  std::array<double, 2> halves = {};  ///< value from either half alone
};

/// How the fit to one half does on the other, both ways together.
struct HeldOut {
  double log_likelihood = 0.0;  ///< under the configured values
  Gain gain;                    ///< of the values fitted to the other half
  ComponentSums before;
  ComponentSums after;
};

/// Result of a tuning.
struct TuningResult {
  std::vector<TunedKnob> knobs;
  HeldOut held_out;
  bool worthwhile = false;  ///< the gain on held-out data is beyond its own scatter
  std::size_t drives = 0;
};

/// Progress of a tuning.
struct TuningProgress {
  std::size_t runs = 0;      ///< of one drive, completed
  std::size_t expected = 0;  ///< in total, approximately
};

/// Receives the progress; called from any thread, one at a time.
using TuningWatcher = std::function<void(const TuningProgress&)>;

/// Two parts that are fitted separately: the halves of a single drive, with equal numbers of measurements, or
/// alternate drives of several.
/// Throws std::invalid_argument if one of them has too few measurements.
std::array<DriveParts, 2> halvesOf(const GainMeter& meter);

/// One set of values for all drives.
/// @param knobs what to tune, see tuningKnobs(); @param runs where the drives are run: here, or elsewhere
/// Throws std::invalid_argument with a message for users if a drive never starts or is too short, or if its start needs
/// truth.
TuningResult tune(std::vector<Knob> knobs, std::vector<TuningDrive> drives, const TuningWatcher& watcher,
                  TuningRuns runs = {});

}  // namespace slipnav
