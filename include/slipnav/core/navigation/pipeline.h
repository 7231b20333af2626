#pragma once
/// From samples in core axes to estimates: initialization, mechanization and filter in one object, for offline use.

#include <cstdint>
#include <memory>
#include <optional>

#include "slipnav/core/navigation/health.h"
#include "slipnav/core/navigation/initializer.h"
#include "slipnav/core/navigation/navigator.h"
#include "slipnav/core/ordering/imu_clock.h"

namespace slipnav {

/// Everything the navigation is configured with.
struct NavigationSetup {
  ImuInputParams imu_input;
  InitializationParams initialization;
  FilterSetup filter;
};

/// Input samples and what became of them.
struct SampleCounts {
  std::uint64_t imu = 0;
  std::uint64_t wheels = 0;
  std::uint64_t rejected = 0;
  std::uint64_t gaps = 0;
  std::uint64_t restarts = 0;  ///< times the clock went back and everything restarted
};

/// Takes samples in order of stamp; restarts when the clock goes back.
class Pipeline {
 public:
  Pipeline(const Planet& planet, const NavigationSetup& setup, FilterEngine::EstimateSink sink);

  /// Passes every innovation of the filter to `sink` from now on.
  void onInnovation(const InnovationSink& sink);

  /// Records what smoothing needs in `history`; call before the first sample.
  void keepHistory(const std::shared_ptr<FilterHistory>& history);

  void push(const ImuSample& sample);
  void push(const WheelMotion& wheels);
  /// Satellite position or velocity; after the initialization only positions, and only with `gnss.use: always`.
  void push(const AntennaFix& fix);
  /// For the initialization source `truth`.
  void setTruth(const NavigationState& truth, bool has_attitude);

  /// Where the estimate started, once it has.
  const std::optional<InitialState>& initial() const { return initial_; }
  const Initializer& initializer() const { return initializer_; }
  const FilterEngine& filter() const { return navigator_.filter(); }
  const SampleCounts& counts() const { return counts_; }
  const HealthMonitor& health() const { return health_; }

 private:
  void use(const ImuSample& sample);
  void tryToStart();
  void restart();

  Planet planet_;
  NavigationSetup setup_;
  FilterEngine::EstimateSink sink_;
  ImuClock imu_clock_;
  Initializer initializer_;
  Navigator navigator_;
  std::optional<InitialState> initial_;
  SampleCounts counts_;
  HealthMonitor health_;
  InnovationSink on_innovation_;
  std::shared_ptr<FilterHistory> history_;
};

}  // namespace slipnav
