#pragma once
/// Several measurements of one instant: each passes its own gate, all that pass are to update the state together.

#include <array>
#include <optional>

#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ekf/engine/filter_params.h"
#include "slipnav/core/ekf/kalman_update.h"

namespace slipnav {

/// Up to four measurements of one instant.
class MeasurementSet {
 public:
  /// A measurement and the name under which it is counted.
  struct Block {
    Component component = kForwardSpeed;
    Measurement measurement{1};
    double variance_factor = 1.0;
  };

  /// @param variance_factor what the variance counts in the update, where it was gated by that of the measurement
  void add(Component component, const Measurement& measurement, double variance_factor = 1.0) {
    blocks_[size_++] = {component, measurement, variance_factor};
  }
  std::size_t size() const { return size_; }
  Block& operator[](std::size_t i) { return blocks_[i]; }

 private:
  std::array<Block, 4> blocks_;
  std::size_t size_ = 0;
};

/// Gates by chi-square quantiles, and keeps count of what passed and what did not. A measurement that has contradicted
/// for long is not the outlier, the state is: then the covariance is opened until it is plausible, and it is used.
class GatedUpdate {
 public:
  explicit GatedUpdate(const FilterParams& params);

  /// Other gates from now on; what has been counted stays.
  void retune(const FilterParams& params);

  /// @return those that passed, one below the other; nothing where none did. P is opened for what has contradicted for
  /// long, and untouched otherwise.
  std::optional<Measurement> select(MeasurementSet& set, Nanoseconds stamp, ErrorCovariance& P);

  /// Of the normalised innovation squared of so many rows.
  double gate(int rows) const { return gate_[static_cast<std::size_t>(rows)]; }

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
