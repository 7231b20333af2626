#include "simulation/params.h"

#include <limits>
#include <stdexcept>

#include "core/parameters/parameter_checker.h"
#include "simulation/ground.h"

namespace slipnav::sim {
namespace {

constexpr Range kNotNegative{0.0, std::numeric_limits<double>::infinity()};
constexpr Range kLever_m{-10.0, 10.0};
constexpr Range kAngle_deg{-180.0, 180.0};

}  // namespace

void VehicleParams::visit(ParameterVisitor& v) {
  v.number("wheel_radius_m", wheel_radius_m, {0.01, 2.0}, "nominal wheel radius");
  v.number("wheelbase_m", wheelbase_m, {0.05, 10.0}, "between front and rear axle");
  v.number("track_m", track_m, {0.05, 10.0}, "between left and right wheels");
  v.number("acceleration_mps2", acceleration_mps2, {0.05, 5.0}, "limit of the speed ramp");
  v.number("assumed_track_factor", assumed_track_factor, {1.0, 3.0},
           "scrub that the controller allows for when it converts a yaw rate into wheel speeds");
  v.number("common_radius_error", common_radius_error, {0.0, 0.1}, "1 sigma of the relative error all wheels share");
  v.number("wheel_radius_error", wheel_radius_error, {0.0, 0.1}, "1 sigma of each wheel's own relative error");
  v.choice("layout", layout, {"two", "four", "six"}, "wheels that have encoders");
}

std::size_t wheelsOf(const std::string& layout) { return layout == "two" ? 2 : layout == "six" ? 6 : 4; }

void GroundChangeParams::visit(ParameterVisitor& v) {
  v.number("slip_offset", slip_offset, {-0.5, 0.9}, "added to the terrain's persistent slip");
  v.number("slip_variation", slip_variation, {0.0, 10.0}, "factor on the terrain's correlated slip and wheel scatter");
  v.number("tilt_deg", tilt_deg, {-30.0, 30.0}, "slope of the whole plane, uphill in the direction of the start");
  v.number("patch_slip", patch_slip, {0.0, 0.9}, "additional slip in soft patches");
  v.number("patch_length_m", patch_length_m, {0.5, 1000.0}, "mean length of a soft patch");
  v.number("patch_spacing_m", patch_spacing_m, {0.5, 1000.0}, "mean length of the ground between two patches");
  v.number("track_factor", track_factor, {0.0, 3.0}, "scrub: effective over geometric track; 0: the terrain's own");
  v.number("turning_point_m", turning_point_m, {-2.0, 2.0},
           "mean of the point ahead of base_link that does not move sideways in a turn");
  v.number("turning_point_std_m", turning_point_std_m, {0.0, 2.0},
           "1 sigma of it along the path; 0: the terrain's own");
}

void BodyParams::visit(ParameterVisitor& v) {
  v.number("heave_m", heave_m, {0.0, 0.5}, "1 sigma of the body's height over the path");
  v.number("sway_m", sway_m, {0.0, 0.5}, "1 sigma of the body's offset to the side");
  v.number("pitch_deg", pitch_deg, {0.0, 20.0}, "1 sigma against the path");
  v.number("roll_deg", roll_deg, {0.0, 20.0}, "1 sigma against the path");
  v.number("stone_m", stone_m, {0.05, 100.0}, "correlation length of the body's motion");
  v.number("frequency_hz", frequency_hz, {0.0, 20.0}, "natural frequency of the suspension; 0: stiff");
  v.number("damping_ratio", damping_ratio, {0.05, 2.0}, "of the suspension");
}

void ShakingParams::visit(ParameterVisitor& v) {
  v.number("broad_mps2", broad_mps2, kNotNegative, "1 sigma in the samples, white, at 0.8 m/s and faster");
  v.number("broad_deg_per_s", broad_deg_per_s, kNotNegative, "1 sigma in the samples, likewise");
  v.number("motor_mps2", motor_mps2, kNotNegative, "amplitude of the motors' first line while the wheels turn");
  v.number("motor_deg_per_s", motor_deg_per_s, kNotNegative, "amplitude of the motors' first line, likewise");
  v.number("motor_turns_per_m", motor_turns_per_m, {0.1, 1e5}, "turns of the motors per meter of wheel travel");
  v.number("engine_mps2", engine_mps2, kNotNegative, "amplitude of the first line of an engine that always runs");
  v.number("engine_deg_per_s", engine_deg_per_s, kNotNegative, "amplitude of the first line, likewise");
  v.number("engine_hz", engine_hz, {0.1, 1e4}, "speed of that engine");
}

void HostStampParams::visit(ParameterVisitor& v) {
  v.number("noise_s", noise_s, {0.0, 0.1}, "1 sigma of the stamps about the true instants; order is kept");
  v.integer("burst", burst, {1.0, 100.0}, "samples that are read, and stamped, together");
  v.number("delay_s", delay_s, {-1.0, 1.0}, "all stamps are late by this");
}

void ImuParams::visit(ParameterVisitor& v) {
  v.number("rate_hz", rate_hz, {10.0, 1000.0}, "samples per second");
  v.choice("sampling", sampling, {"mean", "instantaneous"},
           "over the interval that ends at the stamp, or at the stamp");
  v.number("stamp_jitter_s", stamp_jitter_s, {0.0, 0.01}, "1 sigma of the sampling instants; stamps stay true");
  v.flag("error_free", error_free, "no error and no vibration");
  v.number("lever_arm_x_m", lever_arm_x_m, kLever_m, "sensor seen from base_link, forward");
  v.number("lever_arm_y_m", lever_arm_y_m, kLever_m, "sensor seen from base_link, right");
  v.number("lever_arm_z_m", lever_arm_z_m, kLever_m, "sensor seen from base_link, down");
  v.number("misalignment_roll_deg", misalignment_roll_deg, kAngle_deg, "unknown mounting error");
  v.number("misalignment_pitch_deg", misalignment_pitch_deg, kAngle_deg, "unknown mounting error");
  v.number("misalignment_yaw_deg", misalignment_yaw_deg, kAngle_deg, "unknown mounting error");
  v.number("gyro_noise_deg_per_sqrt_h", gyro_noise_deg_per_sqrt_h, kNotNegative, "angle random walk");
  v.number("accel_noise_mps_per_sqrt_h", accel_noise_mps_per_sqrt_h, kNotNegative, "velocity random walk");
  v.number("gyro_turn_on_bias_deg_per_h", gyro_turn_on_bias_deg_per_h, kNotNegative, "1 sigma, constant in a drive");
  v.number("accel_turn_on_bias_mg", accel_turn_on_bias_mg, kNotNegative, "1 sigma, constant in a drive");
  v.number("gyro_in_run_bias_deg_per_h", gyro_in_run_bias_deg_per_h, kNotNegative, "1 sigma of the wandering part");
  v.number("accel_in_run_bias_ug", accel_in_run_bias_ug, kNotNegative, "1 sigma of the wandering part");
  v.number("bias_correlation_s", bias_correlation_s, {1.0, 1e9}, "time constant of the wandering part");
  v.number("gyro_bias_walk_deg_per_h_per_sqrt_h", gyro_bias_walk_deg_per_h_per_sqrt_h, kNotNegative,
           "random walk of the bias");
  v.number("accel_bias_walk_ug_per_sqrt_h", accel_bias_walk_ug_per_sqrt_h, kNotNegative, "random walk of the bias");
  v.number("scale_factor_ppm", scale_factor_ppm, kNotNegative, "1 sigma of each axis");
  v.number("vibration", vibration, kNotNegative, "factor on the terrain's vibration");
  v.group("shaking", shaking, "vibration that the samples show and that does not move the rover");
  v.group("host_stamps", host_stamps, "stamps that are not the true instants");
}

void EncoderParams::visit(ParameterVisitor& v) {
  v.number("rate_hz", rate_hz, {0.5, 500.0}, "samples per second");
  v.number("counts_per_turn", counts_per_turn, {16.0, 1e9}, "quadrature counts per turn of the wheel");
  v.integer("dead_wheel", dead_wheel, {0.0, 6.0}, "number of the wheel whose encoder stops counting; 0: none");
  v.number("dead_after_s", dead_after_s, kNotNegative, "when it stops, since the start");
  v.group("host_stamps", host_stamps, "stamps that are not the true instants");
}

void GnssParams::visit(ParameterVisitor& v) {
  v.number("rate_hz", rate_hz, {0.1, 500.0}, "fixes per second");
  v.number("horizontal_noise_m", horizontal_noise_m, kNotNegative, "1 sigma, each of north and east");
  v.number("vertical_noise_m", vertical_noise_m, kNotNegative, "1 sigma");
  v.number("correlation_s", correlation_s, {0.0, 3600.0}, "over which errors fall to 1/e; 0: each is independent");
  v.number("outlier_part", outlier_part, {0.0, 1.0}, "fraction of fixes that are outliers without saying so");
  v.number("outlier_m", outlier_m, kNotNegative, "their horizontal error");
  v.number("antenna_x_m", antenna_x_m, kLever_m, "antenna seen from base_link, forward");
  v.number("antenna_y_m", antenna_y_m, kLever_m, "antenna seen from base_link, right");
  v.number("antenna_z_m", antenna_z_m, kLever_m, "antenna seen from base_link, down");
}

void DriveParams::visit(ParameterVisitor& v) {
  v.number("speed_mps", speed_mps, {0.01, 5.0}, "commanded forward speed");
  v.number("initial_rest_s", initial_rest_s, {0.0, 3600.0}, "rest before the drive");
  v.number("initial_straight_m", initial_straight_m, {0.0, 100.0}, "straight drive on firm ground");
  v.number("distance_m", distance_m, {0.0, 1e5}, "driven after the initialization");
  v.number("final_rest_s", final_rest_s, {0.0, 3600.0}, "rest after the drive");
  v.choice("route", route, {"winding", "circle", "straight"}, "shape of the path");
  v.number("circle_radius_m", circle_radius_m, {1.0, 1000.0}, "of the route 'circle'");
  v.number("stuck_after_m", stuck_after_m, kNotNegative, "distance along the route after which the rover gets stuck");
  v.number("stuck_s", stuck_s, {0.0, 3600.0}, "how long its wheels spin there; 0: it does not get stuck");
}

void SimulatorParams::visit(ParameterVisitor& v) {
  v.integer("seed", seed, {0.0, std::numeric_limits<int>::max()}, "fixes every random number of the drive");
  v.choice("terrain", terrain, kTerrainNames, "kind of ground");
  v.number("start_time_s", start_time_s, {0.0, 4e9}, "stamp of the start pose");
  v.number("start_latitude_deg", start_latitude_deg, {-89.0, 89.0}, "geodetic");
  v.number("start_longitude_deg", start_longitude_deg, {-180.0, 180.0}, "east");
  v.number("start_height_m", start_height_m, {-1e4, 1e5}, "above the ellipsoid");
  v.group("drive", drive, "what the operator does");
  v.group("ground", ground, "what is different from the terrain's own ground");
  v.group("vehicle", vehicle, "the rover");
  v.group("body", body, "how the body moves against the path");
  v.group("imu", imu, "inertial sensor");
  v.group("encoder", encoder, "wheel encoders");
  v.group("gps", gps, "fixes for the initialization");
  v.group("truth", truth, "fixes that serve as truth");
}

void SimulatorParams::validate() const {
  checkParameters(*this);
  const auto requireSlower = [this](const char* name, double rate_hz) {
    if (rate_hz > 0.5 * imu.rate_hz) {
      throw std::invalid_argument(std::string(name) + ".rate_hz must not exceed half of imu.rate_hz");
    }
  };
  if (static_cast<std::size_t>(encoder.dead_wheel) > wheelsOf(vehicle.layout)) {
    throw std::invalid_argument("encoder.dead_wheel must not exceed the number of wheels");
  }
  requireSlower("gps", gps.rate_hz);
  requireSlower("truth", truth.rate_hz);
}

}  // namespace slipnav::sim
