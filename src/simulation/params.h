#pragma once
/// Parameters of the simulated drive. Units are in the names; sensor errors are in data-sheet units.

#include <cstddef>
#include <string>

#include "slipnav/core/parameters/parameter_visitor.h"

namespace slipnav::sim {

/// The rover's geometry and its response to commands. Defaults are the paper's rover (Pathfinder).
struct VehicleParams {
  double wheel_radius_m = 0.11;        ///< nominal
  double wheelbase_m = 0.555;          ///< between front and rear axle
  double track_m = 0.685;              ///< between left and right wheels
  double acceleration_mps2 = 0.6;      ///< limit of the speed ramp
  double assumed_track_factor = 1.4;   ///< scrub that the controller allows for when it converts a yaw rate to speeds
  double common_radius_error = 0.005;  ///< 1σ of the relative radius error that all wheels share
  double wheel_radius_error = 0.002;   ///< 1σ of each wheel's own
  std::string layout = "four";         ///< which wheels have encoders, see wheelsOf()

  void visit(ParameterVisitor& v);
};

/// Wheels of a layout: "two", "four" or "six".
std::size_t wheelsOf(const std::string& layout);

/// Differences from the terrain's own ground.
struct GroundChangeParams {
  double slip_offset = 0.0;     ///< added to the persistent slip
  double slip_variation = 1.0;  ///< factor on the correlated slip and on the scatter of the wheels
  double tilt_deg = 0.0;        ///< slope of the whole plane, the start included, uphill in the direction of the start
  double patch_slip = 0.0;      ///< additional slip in soft patches
  double patch_length_m = 3.0;  ///< mean length of a patch
  double patch_spacing_m = 10.0;     ///< mean length of the firm ground between two
  double track_factor = 0.0;         ///< scrub; 0: the terrain's own
  double turning_point_m = 0.0;      ///< mean of the point ahead of base_link that does not move sideways in a turn
  double turning_point_std_m = 0.0;  ///< 1σ along the path; 0: the terrain's own

  void visit(ParameterVisitor& v);
};

/// Motion of the body against the path: over stones, on rocker and suspension.
struct BodyParams {
  double heave_m = 0.0;  ///< 1σ of the height over the path
  double sway_m = 0.0;   ///< 1σ of the offset to the side
  double pitch_deg = 0.0;
  double roll_deg = 0.0;
  double stone_m = 0.6;        ///< correlation length
  double frequency_hz = 0.0;   ///< natural frequency of the suspension; 0: stiff, the body follows at once
  double damping_ratio = 0.3;  ///< of the suspension

  void visit(ParameterVisitor& v);
  bool rocks() const { return heave_m > 0.0 || sway_m > 0.0 || pitch_deg > 0.0 || roll_deg > 0.0; }
};

/// Vibration that the IMU senses and that does not move the rover: the means of the samples are not zero, those of the
/// truth are.
struct ShakingParams {
  double broad_mps2 = 0.0;  ///< 1σ in the samples, white, at 0.8 m/s and faster; slower in proportion
  double broad_deg_per_s = 0.0;
  double motor_mps2 = 0.0;  ///< amplitude of the motors' lines while the wheels turn
  double motor_deg_per_s = 0.0;
  double motor_turns_per_m = 100.0;  ///< of travel: motor turns, gear included
  double engine_mps2 = 0.0;          ///< amplitude of the lines of an engine that always runs
  double engine_deg_per_s = 0.0;
  double engine_hz = 37.0;

  void visit(ParameterVisitor& v);
};

/// Host stamps deviate by at most this many sigma.
inline constexpr double kLargestStampNoise = 4.0;

/// Stamps of a host that reads a sensor when it gets around to it. The samples stay those of the true instants.
struct HostStampParams {
  double noise_s = 0.0;  ///< 1σ of the stamps about the true instants; order is kept
  int burst = 1;         ///< samples that are read, and stamped, together
  double delay_s = 0.0;  ///< all stamps are late by this

  void visit(ParameterVisitor& v);
  bool exact() const { return noise_s == 0.0 && burst == 1 && delay_s == 0.0; }
};

/// The inertial sensor. Defaults: ADIS16495 data sheet, rev. A, block mean at 50 Hz.
struct ImuParams {
  double rate_hz = 50.0;
  std::string sampling = "mean";  ///< over the interval that ends at the stamp, or "instantaneous"
  double stamp_jitter_s = 0.0;  ///< 1σ of the sampling instants about the regular ones; stamps tell the true instants
  bool error_free = false;      ///< true: mean rate and mean specific force without any error or vibration
  double lever_arm_x_m = 0.0;   ///< sensor seen from base_link, body axes (forward, right, down)
  double lever_arm_y_m = 0.0;
  double lever_arm_z_m = 0.0;
  double misalignment_roll_deg = 0.0;  ///< unknown attitude of the sensor in the body
  double misalignment_pitch_deg = 0.0;
  double misalignment_yaw_deg = 0.0;
  double gyro_noise_deg_per_sqrt_h = 0.1;            ///< angle random walk
  double accel_noise_mps_per_sqrt_h = 0.008;         ///< velocity random walk
  double gyro_turn_on_bias_deg_per_h = 30.0;         ///< 1σ, remaining after the maker's and the user's calibration
  double accel_turn_on_bias_mg = 1.5;                ///< 1σ, repeatability
  double gyro_in_run_bias_deg_per_h = 1.6;           ///< 1σ of the Gauss-Markov part
  double accel_in_run_bias_ug = 3.2;                 ///< 1σ of the Gauss-Markov part
  double bias_correlation_s = 1500.0;                ///< time constant of the Gauss-Markov part
  double gyro_bias_walk_deg_per_h_per_sqrt_h = 0.0;  ///< rate random walk
  double accel_bias_walk_ug_per_sqrt_h = 0.0;        ///< acceleration random walk
  double scale_factor_ppm = 200.0;                   ///< 1σ, each axis of both triads
  double vibration = 1.0;  ///< factor on the terrain's vibration that the block mean lets through while driving
  ShakingParams shaking;
  HostStampParams host_stamps;

  void visit(ParameterVisitor& v);
};

/// The wheel encoders.
struct EncoderParams {
  double rate_hz = 10.0;
  double counts_per_turn = 47000.0;  ///< quadrature counts per turn of the wheel, after the gear
  int dead_wheel = 0;                ///< number of the wheel whose encoder stops counting, from 1; 0: none
  double dead_after_s = 60.0;        ///< since the start
  HostStampParams host_stamps;

  void visit(ParameterVisitor& v);
};

/// A receiver that gives one fix per epoch with white noise.
struct GnssParams {
  double rate_hz = 10.0;
  double horizontal_noise_m = 0.01;  ///< 1σ, each of north and east
  double vertical_noise_m = 0.02;    ///< 1σ
  double correlation_s = 0.0;        ///< over which errors fall to 1/e; 0: each is independent
  double outlier_part = 0.0;         ///< fraction of fixes that are outliers
  double outlier_m = 30.0;           ///< their horizontal error, in any direction
  double antenna_x_m = 0.0;          ///< antenna seen from base_link, body axes (forward, right, down)
  double antenna_y_m = 0.0;
  double antenna_z_m = 0.0;

  void visit(ParameterVisitor& v);
};

/// What the scripted operator does: rest, straight initialization drive, winding route, rest.
struct DriveParams {
  double speed_mps = 0.8;
  double initial_rest_s = 30.0;
  double initial_straight_m = 12.0;
  double distance_m = 150.0;  ///< driven after the initialization
  double final_rest_s = 5.0;
  std::string route = "winding";  ///< or "circle", "straight"
  double circle_radius_m = 5.0;
  double stuck_after_m = 10.0;  ///< of the route
  double stuck_s = 0.0;         ///< how long the wheels spin there while the rover stands

  void visit(ParameterVisitor& v);
};

/// Block `simulator`.
struct SimulatorParams {
  int seed = 1;
  std::string terrain = "rough";        ///< one of kTerrainNames (ground.h)
  double start_time_s = 1.6e9;          ///< stamp of the start pose
  double start_latitude_deg = 39.7389;  ///< Point Marion, Pennsylvania: the paper's ash pile
  double start_longitude_deg = -79.8987;
  double start_height_m = 250.0;
  DriveParams drive;
  GroundChangeParams ground;
  VehicleParams vehicle;
  BodyParams body;
  ImuParams imu;
  EncoderParams encoder;
  GnssParams gps;
  GnssParams truth;  ///< post-processed differential fixes

  void visit(ParameterVisitor& v);
  /// Throws std::invalid_argument that names the field.
  void validate() const;
};

}  // namespace slipnav::sim
