#pragma once
/// How likely a drive is under a configuration, from the filter's innovations, without any truth.
///
/// Each measurement is scored against its prediction from all earlier ones, including the noise learned until then:
/// the product over a drive is the likelihood of the configuration (A. P. Dawid, Present position and potential
/// developments, J. R. Stat. Soc. A 147(2), 1984; for filters F. C. Schweppe, IEEE TIT 11(1), 1965).

#include <array>
#include <string>
#include <vector>

#include "config/config.h"
#include "core/navigation/sample_merger.h"
#include "slipnav/core/ekf/engine/innovation.h"

namespace slipnav {

/// A recording in memory.
struct TuningDrive {
  std::string name;
  Config config;                ///< what its samples were read with, poses of the sensors included
  std::vector<Sample> samples;  ///< in order of arrival
};

/// ρ(d²) of an innovation of `rows` rows with normalized square `squared`: unchanged inside the gate, and
/// c² (1 + ln(d²/c²)) beyond, c² the 99.9 % quantile. The density exp(−½ρ) has a power-law tail,
/// so that a jump in slip counts as an outlier and not as evidence for larger noise.
double robustSquare(int rows, double squared);

/// Of the innovations of one kind in one stretch of time.
struct InnovationSums {
  double measurements = 0.0;
  double rows = 0.0;
  double log_likelihood = 0.0;  ///< Σ −½ (ρ(rᵀS⁻¹r) + ln |S| + rows · ln 2π)
  double squared = 0.0;         ///< Σ ρ(rᵀS⁻¹r)

  void add(const InnovationSize& size);
  InnovationSums& operator+=(const InnovationSums& other);
};

using ComponentSums = std::array<InnovationSums, kComponents>;

/// Length of a stretch [s].
inline constexpr double kStretch_s = 5.0;

/// A drive in stretches, counted from the stamp of its first sample of the IMU.
using DriveLikelihood = std::vector<ComponentSums>;

/// How many stretches a drive has.
std::size_t stretchCount(const TuningDrive& drive);

/// Runs the navigation over a drive. If it never starts all sums are empty.
/// @param config to be judged; its wheel.stamp_delay_s may differ from that of the drive
/// @param stretches how many of them to run
DriveLikelihood likelihoodOf(const TuningDrive& drive, const Config& config, std::size_t stretches);

}  // namespace slipnav
