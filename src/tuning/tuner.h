#pragma once
/// Noise, delay and slip of a robot from its own drives: maximum likelihood of the innovations, judged on what it was
/// not fitted to.

#include <array>
#include <optional>

#include "tuning/selection.h"

namespace slipnav {

/// What became of a knob.
struct TunedKnob {
  Knob knob;
  bool told = false;      ///< the drives say something about it; otherwise it stays
  double position = 0.0;  ///< where it is now, 0: as configured
  /// 1σ of the position, from the curvature of likelihood and prior and from how far the halves are apart.
  std::optional<double> std;
  std::array<double, 2> halves = {};  ///< where either half alone has put it
};

/// How what was fitted to one half does on the other, both ways together.
struct HeldOut {
  double log_likelihood = 0.0;  ///< under the configured values
  Gain gain;                    ///< of the values that were fitted to the other half
  ComponentSums before;
  ComponentSums after;
};

/// What a tuning has found.
struct TuningResult {
  std::vector<TunedKnob> knobs;
  HeldOut held_out;
  bool worthwhile = false;  ///< the gain on what was held out is beyond its own scatter
  std::size_t drives = 0;
};

/// How far a tuning has come.
struct TuningProgress {
  std::size_t runs = 0;      ///< of one drive, that have ended
  std::size_t expected = 0;  ///< of all, roughly
};

/// Who is told; called from any thread, one at a time.
using TuningWatcher = std::function<void(const TuningProgress&)>;

/// Two parts that are fitted apart: of one drive its halves, with as many measurements each, of several every other
/// drive.
/// Throws std::invalid_argument where one of them has too few measurements.
std::array<DriveParts, 2> halvesOf(const GainMeter& meter);

/// One set of values for all drives.
/// @param knobs what to tune, see tuningKnobs()
/// Throws std::invalid_argument in words for a user when a drive never starts or is too short, or when its start needs
/// truth.
TuningResult tune(std::vector<Knob> knobs, std::vector<TuningDrive> drives, const TuningWatcher& watcher);

}  // namespace slipnav
