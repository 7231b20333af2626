#include "slipnav/sim/params.h"

#include <limits>
#include <stdexcept>

#include "slipnav/config/parameter_checker.h"
#include "slipnav/sim/ground.h"

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
           "scrub that the controller allows for when it turns a yaw rate into wheel speeds");
  v.number("common_radius_error", common_radius_error, {0.0, 0.1}, "1 sigma of the relative error all wheels share");
  v.number("wheel_radius_error", wheel_radius_error, {0.0, 0.1}, "1 sigma of each wheel's own relative error");
}

void ImuParams::visit(ParameterVisitor& v) {
  v.number("rate_hz", rate_hz, {20.0, 1000.0}, "samples per second, each the mean over its interval");
  v.number("stamp_jitter_s", stamp_jitter_s, {0.0, 0.01}, "1 sigma of the sampling instants; stamps stay true");
  v.flag("error_free", error_free, "no error and no vibration");
  v.number("lever_arm_x_m", lever_arm_x_m, kLever_m, "sensor seen from base_link, forward");
  v.number("lever_arm_y_m", lever_arm_y_m, kLever_m, "sensor seen from base_link, right");
  v.number("lever_arm_z_m", lever_arm_z_m, kLever_m, "sensor seen from base_link, down");
  v.number("misalignment_roll_deg", misalignment_roll_deg, kAngle_deg, "mounting error that nobody knows of");
  v.number("misalignment_pitch_deg", misalignment_pitch_deg, kAngle_deg, "mounting error that nobody knows of");
  v.number("misalignment_yaw_deg", misalignment_yaw_deg, kAngle_deg, "mounting error that nobody knows of");
  v.number("gyro_noise_deg_per_sqrt_h", gyro_noise_deg_per_sqrt_h, kNotNegative, "angle random walk");
  v.number("accel_noise_mps_per_sqrt_h", accel_noise_mps_per_sqrt_h, kNotNegative, "velocity random walk");
  v.number("gyro_turn_on_bias_deg_per_h", gyro_turn_on_bias_deg_per_h, kNotNegative, "1 sigma, constant in a drive");
  v.number("accel_turn_on_bias_mg", accel_turn_on_bias_mg, kNotNegative, "1 sigma, constant in a drive");
  v.number("gyro_in_run_bias_deg_per_h", gyro_in_run_bias_deg_per_h, kNotNegative, "1 sigma of the wandering part");
  v.number("accel_in_run_bias_ug", accel_in_run_bias_ug, kNotNegative, "1 sigma of the wandering part");
  v.number("bias_correlation_s", bias_correlation_s, {1.0, 1e9}, "time constant of the wandering part");
  v.number("scale_factor_ppm", scale_factor_ppm, kNotNegative, "1 sigma of each axis");
  v.number("vibration", vibration, kNotNegative, "factor on the terrain's vibration");
}

void EncoderParams::visit(ParameterVisitor& v) {
  v.number("rate_hz", rate_hz, {0.5, 500.0}, "samples per second");
  v.number("counts_per_turn", counts_per_turn, {16.0, 1e9}, "quadrature counts per turn of the wheel");
}

void GnssParams::visit(ParameterVisitor& v) {
  v.number("rate_hz", rate_hz, {0.1, 500.0}, "fixes per second");
  v.number("horizontal_noise_m", horizontal_noise_m, kNotNegative, "1 sigma, each of north and east");
  v.number("vertical_noise_m", vertical_noise_m, kNotNegative, "1 sigma");
  v.number("antenna_x_m", antenna_x_m, kLever_m, "antenna seen from base_link, forward");
  v.number("antenna_y_m", antenna_y_m, kLever_m, "antenna seen from base_link, right");
  v.number("antenna_z_m", antenna_z_m, kLever_m, "antenna seen from base_link, down");
}

void DriveParams::visit(ParameterVisitor& v) {
  v.number("speed_mps", speed_mps, {0.01, 5.0}, "commanded forward speed");
  v.number("initial_rest_s", initial_rest_s, {0.0, 3600.0}, "rest before the drive");
  v.number("initial_straight_m", initial_straight_m, {0.0, 100.0}, "straight drive on firm ground");
  v.number("distance_m", distance_m, {0.0, 1e5}, "driven after the initialisation");
  v.number("final_rest_s", final_rest_s, {0.0, 3600.0}, "rest after the drive");
}

void SimulatorParams::visit(ParameterVisitor& v) {
  v.integer("seed", seed, {0.0, std::numeric_limits<int>::max()}, "fixes every random number of the drive");
  v.choice("terrain", terrain, kTerrainNames, "kind of ground");
  v.number("start_time_s", start_time_s, {0.0, 4e9}, "stamp of the start pose");
  v.number("start_latitude_deg", start_latitude_deg, {-89.0, 89.0}, "geodetic");
  v.number("start_longitude_deg", start_longitude_deg, {-180.0, 180.0}, "east");
  v.number("start_height_m", start_height_m, {-1e4, 1e5}, "above the ellipsoid");
  v.group("drive", drive, "what the operator does");
  v.group("vehicle", vehicle, "the rover");
  v.group("imu", imu, "inertial sensor");
  v.group("encoder", encoder, "wheel encoders");
  v.group("gps", gps, "fixes for the initialisation");
  v.group("truth", truth, "fixes that serve as truth");
}

void SimulatorParams::validate() const {
  checkParameters(*this);
  const auto requireSlower = [this](const char* name, double rate_hz) {
    if (rate_hz > 0.5 * imu.rate_hz) {
      throw std::invalid_argument(std::string(name) + ".rate_hz must not exceed half of imu.rate_hz");
    }
  };
  requireSlower("encoder", encoder.rate_hz);
  requireSlower("gps", gps.rate_hz);
  requireSlower("truth", truth.rate_hz);
}

}  // namespace slipnav::sim
