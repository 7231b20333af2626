#pragma once
/// Simultaneous measurements: each passes its own gate, all that pass update the state together.

#include <array>
#include <optional>

#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/engine/filter_params.h"
#include "slipnav/core/ekf/kalman_update.h"

namespace slipnav {

/// Up to four simultaneous measurements.
class MeasurementSet {
 public:
  /// A measurement and the name it is counted under.
  struct Block {
    Component component = kForwardSpeed;
    Measurement measurement{1};
    double variance_factor = 1.0;
  };

  /// @param variance_factor on the variance used in the update, relative to that used by the gate
  void add(Component component, const Measurement& measurement, double variance_factor = 1.0) {
    blocks_[size_++] = {component, measurement, variance_factor};
  }
  std::size_t size() const { return size_; }
  Block& operator[](std::size_t i) { return blocks_[i]; }

 private:
  std::array<Block, 4> blocks_;
  std::size_t size_ = 0;
};

/// Gates by chi-square quantiles, and counts what passed and what did not. When a measurement has contradicted
/// for long, the state is wrong, not the measurement: the covariance is inflated until it is plausible, and it is used.
class GatedUpdate {
 public:
  explicit GatedUpdate(const FilterParams& params);

  /// Other gates from now on; the counts stay.
  void retune(const FilterParams& params);

  /// @return those that passed, stacked; nothing if none did. P is inflated for what has contradicted for
  /// long, and otherwise unchanged.
  std::optional<Measurement> select(MeasurementSet& set, Nanoseconds stamp, ErrorCovariance& P);

  /// Limit of the normalized innovation squared for this many rows.
  double gate(int rows) const { return gate_[static_cast<std::size_t>(rows)]; }
  /// The same for a standstill.
  double zeroGate(int rows) const { return zero_gate_[static_cast<std::size_t>(rows)]; }

  const ComponentStatus& status(Component component) const { return status_[component]; }

 private:
  bool passes(MeasurementSet::Block& block, Nanoseconds stamp, ErrorCovariance& P);
  double patience(Component component) const;
  double limit(const MeasurementSet::Block& block) const;

  double max_rejection_s_;
  double max_standstill_doubt_s_;
  std::array<double, kMaxMeasurementRows + 1> gate_;       ///< by degrees of freedom
  std::array<double, kMaxMeasurementRows + 1> zero_gate_;  ///< the same for zero velocity and zero rate
  std::array<ComponentStatus, kComponents> status_;
};

}  // namespace slipnav
