#pragma once
/// The slip samples of one window as the regression takes them: cleaned, with the origin of time made explicit.

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace slipnav {

/// Slip ratios in (−1, 1) at times in seconds on any one clock.
struct SlipSamples {
  std::vector<double> times_s;
  std::vector<double> slips;
  /// Where the time of the Brownian kernel starts, on the clock of times_s. If empty: one sample interval before the
  /// first usable sample, so that the first sample is at one interval.
  std::optional<double> origin_s;
};

/// The usable samples of a window, with times since its origin.
struct SlipWindow {
  double origin_s = 0.0;
  double interval_s = 0.0;  ///< median time between samples
  Eigen::VectorXd times;    ///< seconds since origin_s, strictly increasing
  Eigen::VectorXd slips;
  int left_out = 0;  ///< samples not used: not finite, |slip| ≥ 1, or not later than the one before

  Eigen::Index size() const { return times.size(); }
};

/// Skips unusable samples and chooses the origin. A saturated slip (|s| = 1: a wheel that spins in place or is locked)
/// has no likelihood under a Gaussian model and is skipped, as in the paper. Gaps are kept as they are.
/// Throws std::invalid_argument if times and slips differ in length.
SlipWindow makeSlipWindow(const SlipSamples& samples);

/// Scale of a window, from which priors free of unit and origin are built. Powers are floored, so that constant slip
/// gives finite priors.
struct WindowScale {
  double interval_s = 0.0;
  double span_s = 0.0;       ///< from the first to the last sample
  double mean_time_s = 0.0;  ///< since the origin
  Eigen::Index count = 0;
  double power = 0.0;             ///< mean square of slip
  double variance = 0.0;          ///< mean square about the mean
  double difference_power = 0.0;  ///< half the mean square of successive differences: white noise, and little else
};

/// @param slip_floor smallest standard deviation of slip that is distinguished from constant slip
/// Throws std::invalid_argument for fewer than two samples.
WindowScale measureScale(const SlipWindow& window, double slip_floor);

/// Whether the slip of the window varies by less than the floor.
bool isConstant(const SlipWindow& window, double slip_floor);

}  // namespace slipnav
