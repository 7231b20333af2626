#pragma once
/// What Starter, Mechanizer and Estimator tell each other besides steps: as messages between nodelets, directly
/// offline.

#include <cstdint>
#include <optional>

#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/ins/ins_engine.h"

namespace slipnav {

/// Starter to Mechanizer and Estimator: where an estimate starts.
struct Start {
  std::uint32_t number = 0;           ///< counts starts, whatever their reason; the newest one is valid
  std::uint32_t session = 0;          ///< how often the clock of the IMU has gone back before it
  std::optional<InitialState> state;  ///< nothing: the estimate ends, a new start is searched for
};

/// Estimator to Mechanizer: how far to go, and the corrected state.
struct Reply {
  std::uint32_t start = 0;  ///< number of the start that it follows from
  std::optional<Correction> correction;
  Nanoseconds run_until = 0;  ///< no step is needed beyond the first one that ends at or after this
};

}  // namespace slipnav
