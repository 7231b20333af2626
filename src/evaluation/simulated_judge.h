#pragma once
/// Compares the estimates of a simulated drive with the simulator's own truth, which includes attitude and velocity.

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "simulation/truth_state.h"
#include "slipnav/core/ekf/engine/filter_data.h"
#include "slipnav/core/navigation/health.h"

namespace slipnav {

/// Figures of a simulated drive beyond Metrics. Names equal the keys of `simulation.json`.
struct SimulationFigures {
  /// Squared normalized errors per degree of freedom (three) at the end of the route; 1 if P is honest.
  std::optional<double> nees_end_attitude;
  std::optional<double> nees_end_velocity;
  std::optional<double> nees_end_position;
  std::int64_t stops_seen = 0;           ///< standstills of 1.5 s or more between driving, after the initialization
  std::int64_t stops_used = 0;           ///< of those, with a zero update
  double largest_speed_mps = 0.0;        ///< of the estimate, all directions
  double largest_wheel_speed_mps = 0.0;  ///< of the wheels' surface
  double largest_error_m = 0.0;          ///< of the position
  double longest_beyond_3sigma_s = 0.0;  ///< longest time that a component of the position error was beyond 3σ
  Alarms alarms;
};

/// One object of `simulation.json`.
std::string figuresJson(const SimulationFigures& figures);

/// Takes truth and estimates in order.
class SimulatedJudge {
 public:
  /// @param route_end_m distance since the start at which the route ends
  SimulatedJudge(const Planet& planet, const Vector3& imu_position_b, double route_end_m)
      : planet_(planet), imu_position_b_(imu_position_b), route_end_m_(route_end_m) {}

  /// Before the estimate that is made from the IMU sample with this stamp.
  void addTruth(Nanoseconds imu_stamp, const sim::TruthState& truth);
  void compare(const Estimate& estimate, const ErrorCovariance& P);

  const SimulationFigures& figures() const { return figures_; }

 private:
  struct StampedTruth {
    Nanoseconds imu_stamp;
    sim::TruthState truth;
  };
  const sim::TruthState* truthAt(Nanoseconds imu_stamp);
  void followStops(const sim::TruthState& truth, bool stationary);
  void followErrors(Nanoseconds stamp, const ErrorVector& error, const ErrorCovariance& P);

  Planet planet_;
  Vector3 imu_position_b_;
  double route_end_m_;
  std::deque<StampedTruth> truths_;
  std::optional<Nanoseconds> beyond_since_;
  std::optional<Nanoseconds> rest_since_;
  bool rest_used_ = false;
  bool has_moved_ = false;
  SimulationFigures figures_;
};

}  // namespace slipnav
