#include "calibration/calibration_report.h"

#include <iomanip>
#include <locale>
#include <sstream>

#include "config/yaml_writer.h"

namespace slipnav {
namespace {

constexpr int kNameWidth = 28;
constexpr int kNumberWidth = 12;

std::ostringstream plainStream() {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << std::fixed;
  return out;
}

std::string number(double value, int decimals) {
  std::ostringstream out = plainStream();
  out << std::setprecision(decimals) << value;
  return out.str();
}

class Table {
 public:
  Table() : out_(plainStream()) { row("quantity", "configured", "estimated", "1 sigma"); }

  void add(const std::string& name, double configured, double estimated, double std, int decimals) {
    row(name, number(configured, decimals), number(estimated, decimals), number(std, decimals));
  }
  /// For a quantity without a configured value.
  void add(const std::string& name, const Calibrated& found, int decimals) {
    row(name, "-", number(found.value, decimals), number(found.std, decimals));
  }
  std::string text() const { return out_.str(); }

 private:
  void row(const std::string& name, const std::string& configured, const std::string& estimated,
           const std::string& std) {
    out_ << std::left << std::setw(kNameWidth) << name << std::right << std::setw(kNumberWidth) << configured
         << std::setw(kNumberWidth) << estimated << std::setw(kNumberWidth) << std << "\n";
  }

  std::ostringstream out_;
};

const std::optional<Calibrated>& ratioOf(const WheelParams& wheel, const CalibrationResult& result) {
  return wheel.y_m < 0.0 ? result.right_radius_ratio : result.left_radius_ratio;
}

void addWheels(const Config& config, const CalibrationResult& result, Table& table) {
  if (!result.has_wheel_rates && result.left_radius_ratio) {
    table.add("ground over odometry speed", *result.left_radius_ratio, 5);
    return;
  }
  const std::vector<WheelParams> wheels = calibratedWheels(config, result);
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    if (const std::optional<Calibrated>& ratio = ratioOf(wheels[i], result)) {
      const double old_m = config.wheels[i].radius_m;
      table.add("radius " + wheels[i].name + " [m]", old_m, wheels[i].radius_m, old_m * ratio->std, 6);
    }
  }
  if (result.scrub_factor) {
    const Calibrated& scrub = *result.scrub_factor;
    const double old = config.wheel.scrub_factor;
    table.add("scrub factor", old, scrub.value, scrub.std, 4);
    table.add("effective track [m]", old * *result.track_m, scrub.value * *result.track_m, scrub.std * *result.track_m,
              4);
  }
}

void addMount(const Config& config, const CalibrationResult& result, Table& table) {
  const MountParams mount = calibratedMount(config, result);
  if (result.mount_pitch_rad) {
    table.add("IMU turned nose up [deg]",
              {radToDeg(result.mount_pitch_rad->value), radToDeg(result.mount_pitch_rad->std)}, 3);
  }
  if (result.mount_yaw_rad) {
    table.add("IMU turned right [deg]", {radToDeg(result.mount_yaw_rad->value), radToDeg(result.mount_yaw_rad->std)},
              3);
  }
  if (result.mount_pitch_rad) {
    table.add("imu.mount.pitch_deg", config.imu.mount.pitch_deg, mount.pitch_deg, radToDeg(result.mount_pitch_rad->std),
              3);
  }
  if (result.mount_yaw_rad) {
    table.add("imu.mount.yaw_deg", config.imu.mount.yaw_deg, mount.yaw_deg, radToDeg(result.mount_yaw_rad->std), 3);
  }
}

/// The configuration block to write, with the exact names of its keys.
struct WheelBlock {
  std::vector<WheelParams> wheels;
  void visit(ParameterVisitor& v) { v.list("wheels", wheels, "calibrated on firm ground; the wheels of a side alike"); }
};

struct MountBlock {
  MountParams mount;
  void visit(ParameterVisitor& v) { v.group("mount", mount, "calibrated"); }
};

struct ImuBlock {
  MountBlock imu;
  void visit(ParameterVisitor& v) { v.group("imu", imu, "the inertial sensor"); }
};

void describeStd(const char* what, const std::optional<Calibrated>& found, double unit, int decimals,
                 std::ostream& out) {
  if (found) {
    out << "# 1 sigma of " << what << ": " << number(found->std * unit, decimals) << "\n";
  }
}

}  // namespace

std::string calibrationTable(const Config& config, const CalibrationResult& result) {
  Table table;
  addWheels(config, result, table);
  addMount(config, result, table);
  if (result.slip) {
    table.add("slip beyond firm ground [%]", {100.0 * result.slip->value, 100.0 * result.slip->std}, 2);
  }
  if (result.turn_center_m) {
    table.add("center of turn ahead [m]", *result.turn_center_m, 4);
  }
  std::ostringstream out = plainStream();
  out << table.text() << std::setprecision(0) << "from " << result.distance_m << " m with "
      << radToDeg(result.turned_rad) << " deg of turns and " << result.fixes << " truth positions; "
      << std::setprecision(3) << "heading known to " << radToDeg(result.heading_std_rad) << " deg\n";
  for (const std::string& reason : result.not_observable) {
    out << "not observable: " << reason << "\n";
  }
  for (const std::string& warning : result.warnings) {
    out << "warning: " << warning << "\n";
  }
  return out.str();
}

std::string calibrationYaml(const Config& config, const CalibrationResult& result) {
  std::ostringstream out = plainStream();
  const bool has_radii = result.has_wheel_rates && result.left_radius_ratio;
  if (has_radii) {
    describeStd("the left radii [%]", result.left_radius_ratio, 100.0, 3, out);
    describeStd("the right radii [%]", result.right_radius_ratio, 100.0, 3, out);
  }
  describeStd("wheel.scrub_factor", result.scrub_factor, 1.0, 4, out);
  describeStd("the pitch of the IMU [deg]", result.mount_pitch_rad, radToDeg(1.0), 3, out);
  describeStd("the yaw of the IMU [deg]", result.mount_yaw_rad, radToDeg(1.0), 3, out);
  if (has_radii) {
    out << toYaml(WheelBlock{calibratedWheels(config, result)});
  }
  if (!result.has_wheel_rates && result.left_radius_ratio) {
    describeStd("wheel.odometry_scale [%]", result.left_radius_ratio, 100.0, 3, out);
    out << "wheel:\n  odometry_scale: " << number(config.wheel.odometry_scale * result.left_radius_ratio->value, 5)
        << "\n";
  }
  if (result.scrub_factor) {
    out << "\nwheel:\n  scrub_factor: " << number(result.scrub_factor->value, 5) << "\n";
  }
  if (result.mount_pitch_rad || result.mount_yaw_rad) {
    out << "\n" << toYaml(ImuBlock{{calibratedMount(config, result)}});
  }
  return out.str();
}

}  // namespace slipnav
