#pragma once
/// Motion of the rover over the terrain, integrated in steps of about a millisecond.

#include <Eigen/Core>

#include "simulation/body_motion.h"
#include "simulation/drive_train.h"
#include "simulation/ground.h"
#include "simulation/params.h"
#include "simulation/truth_state.h"

namespace slipnav::sim {

/// Pose and rates at one instant. Axes: body forward-right-down; tangent plane east-north-up, fixed to the planet.
struct Kinematics {
  Vector3 position_enu_m = Vector3::Zero();
  Matrix3 C_b_to_enu = Matrix3::Identity();
  Vector3 v_eb_enu = Vector3::Zero();
  Vector3 v_eb_b = Vector3::Zero();
  Vector3 omega_eb_b = Vector3::Zero();
  PerWheel wheel_angle_rad = {};
  PerWheel wheel_rate_radps = {};
  PerWheel slip = {};
  double slip_angle_rad = 0.0;
  double distance_m = 0.0;
  bool standstill = true;
};

/// Slip ratio of the paper: 1 − v/(rω) when driving, rω/v − 1 when braking, within [−1, 1]; 0 at standstill.
double slipRatio(double ground_speed_mps, double surface_speed_mps);

/// A place where the wheels spin for a while and the rover stands.
struct StuckPlace {
  double distance_m = 0.0;  ///< distance to it
  double duration_s = 0.0;
};

/// Integrates commands to poses, with the slip of the ground.
class RoverMotion {
 public:
  RoverMotion(const VehicleParams& vehicle, const GroundParams& ground, double start_heading_rad, double straight_m,
              std::uint64_t seed, const BodyParams& body = {}, const StuckPlace& stuck = {});

  /// Advances by one fine step under a command; once nothing moves, the state stays exactly constant.
  void advance(double forward_mps, double yaw_rate_radps, double dt_s);

  const Kinematics& state() const { return state_; }
  /// Travel of the wheel surface [m], never decreasing.
  double travel() const { return value_[kTravel]; }
  /// The true radii [m], which the estimator does not know.
  const PerWheel& wheelRadii() const { return radius_m_; }

 private:
  /// State variables that are integrated over time.
  enum Index {
    kEast,
    kNorth,
    kHeading,
    kTravel,
    kDistance,
    kWheelAngle,
    kBody = kWheelAngle + kWheelCount,  ///< position of a sprung body, then its rate
    kBodyRate = kBody + kBodyAxes,
    kIntegralCount = kBodyRate + kBodyAxes
  };
  using Integrals = Eigen::Matrix<double, kIntegralCount, 1>;
  /// History of the multi-step integration.
  struct History {
    Integrals rate = Integrals::Zero();   ///< one step ago
    Integrals slope = Integrals::Zero();  ///< divided difference of the rates one and two steps ago
    double dt_s = 0.0;                    ///< length of the last step
    double earlier_dt_s = 0.0;            ///< and of the one before
  };

  void integrate(double dt_s);
  void evaluate();
  void setAttitude(const SurfacePoint& surface);
  void moveBody(const SurfacePoint& surface, const Slippage& slippage);
  void addHeave(const Slippage& slippage);
  void turnWheels(const Slippage& slippage, double yaw_rate_radps);
  void rockBody();
  bool bodyHolds();
  double grip() const;

  VehicleParams vehicle_;
  TerrainFollower terrain_;
  SlipModel slip_model_;
  PerWheel radius_m_;
  SpeedRamp forward_;
  SpeedRamp difference_;  ///< half the left wheels' speed minus the right ones'
  BodyMotion body_;
  StuckPlace stuck_;
  double stuck_time_s_ = 0.0;  ///< since it got stuck
  Integrals value_ = Integrals::Zero();
  Integrals rate_ = Integrals::Zero();
  History history_;
  Kinematics state_;
};

}  // namespace slipnav::sim
