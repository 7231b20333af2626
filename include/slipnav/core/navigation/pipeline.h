#pragma once
/// From samples in core axes to estimates: initialization, mechanization and filter in one object, for offline use.

#include <cstdint>
#include <memory>
#include <optional>

#include "slipnav/core/ekf/engine/filter_engine.h"
#include "slipnav/core/navigation/health.h"
#include "slipnav/core/navigation/initializer.h"

namespace slipnav {

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
  Pipeline(const Pipeline& other);
  Pipeline(Pipeline&& other) noexcept;
  ~Pipeline();

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
  const Initializer& initializer() const;
  const FilterEngine& filter() const;
  const SampleCounts& counts() const { return counts_; }
  const HealthMonitor& health() const { return health_; }

 private:
  struct Parts;

  void use(const ImuSample& sample);
  void takeNews();

  std::unique_ptr<Parts> parts_;
  bool uses_fixes_;  ///< while driving
  FilterEngine::EstimateSink sink_;
  std::optional<InitialState> initial_;
  SampleCounts counts_;
  HealthMonitor health_;
};

}  // namespace slipnav
