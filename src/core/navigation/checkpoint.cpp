#include "core/navigation/checkpoint.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>
#include <map>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "core/base/atomic_file.h"
#include "core/base/square.h"
#include "core/base/text.h"

namespace slipnav {
namespace {

constexpr const char* kFormat = "slipnav checkpoint 2";
constexpr std::size_t kMaxHyperparameters = 64;
constexpr double kUnitTolerance = 1e-6;

using Values = std::vector<double>;

/// FNV-1a, 64 bits.
std::string checksumOf(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  std::ostringstream digits;
  digits.imbue(std::locale::classic());
  digits << std::hex << hash;
  return digits.str();
}

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument("checkpoint " + what); }

template <class Derived>
Values valuesOf(const Eigen::MatrixBase<Derived>& m) {
  Values values;
  for (Eigen::Index row = 0; row < m.rows(); ++row) {
    for (Eigen::Index column = 0; column < m.cols(); ++column) {
      values.push_back(m(row, column));
    }
  }
  return values;
}

Values valuesOf(const Geodetic& position) { return {position.latitude_rad, position.longitude_rad, position.height_m}; }

Values valuesOf(const VehicleState& v) {
  return {v.wheel_scale, v.slow_slip, v.fast_slip, v.side_slip, v.mount_pitch_rad, v.mount_yaw_rad};
}

void writeLine(const char* name, const Values& values, std::ostream& text) {
  text << name;
  for (const double value : values) {
    text << ' ' << value;
  }
  text << '\n';
}

/// The lines of a checkpoint by name.
class Lines {
 public:
  explicit Lines(const std::string& body) {
    std::istringstream lines(body);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t space = std::min(line.find(' '), line.size());
      values_[line.substr(0, space)] = line.substr(space);
    }
  }

  template <class Integer>
  Integer integer(const std::string& name) const {
    const std::string& text = at(name);
    Integer value = 0;
    const char* begin = text.data() + std::min<std::size_t>(text.size(), 1);  // after the space
    const std::from_chars_result result = std::from_chars(begin, text.data() + text.size(), value);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size()) {
      refuse("has no whole number in '" + name + "'");
    }
    return value;
  }

  Values list(const std::string& name, std::size_t largest_size) const {
    Values values;
    std::istringstream words(at(name));
    for (std::string word; words >> word;) {
      const std::optional<double> value = parseNumber(word);
      if (!value || values.size() == largest_size) {
        refuse("has a wrong value in '" + name + "'");
      }
      values.push_back(*value);
    }
    return values;
  }

  Values numbers(const std::string& name, std::size_t size) const {
    const Values values = list(name, size);
    if (values.size() != size) {
      refuse("has too few values in '" + name + "'");
    }
    return values;
  }

  Vector3 vector(const std::string& name) const { return Vector3(numbers(name, 3).data()); }

  Geodetic position(const std::string& name) const {
    const Values values = numbers(name, 3);
    return {values[0], values[1], values[2]};
  }

 private:
  const std::string& at(const std::string& name) const {
    const auto found = values_.find(name);
    if (found == values_.end()) {
      refuse("lacks '" + name + "'");
    }
    return found->second;
  }

  std::map<std::string, std::string> values_;
};

/// The part covered by the checksum. Throws if the checksum does not match.
std::string checkedBody(const std::string& text) {
  if (text.compare(0, std::char_traits<char>::length(kFormat), kFormat) != 0) {
    refuse("has another format or version");
  }
  const std::string marker = "\nchecksum ";
  const std::size_t end = text.rfind(marker);
  if (end == std::string::npos) {
    refuse("is truncated");
  }
  const std::string body = text.substr(0, end + 1);
  if (text.substr(end + marker.size()) != checksumOf(body) + "\n") {
    refuse("is damaged: its checksum is wrong");
  }
  return body;
}

void checkState(const InitialState& state) {
  const Eigen::LLT<ErrorCovariance> cholesky(state.P);
  const bool possible = state.nav.stamp > 0 && std::abs(state.nav.q_b_to_n.norm() - 1.0) < kUnitTolerance &&
                        std::abs(state.nav.position.latitude_rad) < 0.5 * kPi &&
                        std::abs(state.origin.latitude_rad) < 0.5 * kPi && state.standstill_variance >= 0.0 &&
                        state.P.isApprox(state.P.transpose(), kUnitTolerance) && cholesky.info() == Eigen::Success;
  if (!possible) {
    refuse("contains an impossible state");
  }
}

std::string readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    refuse("cannot be read");
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string previousOf(const std::string& file) { return file + ".1"; }

}  // namespace

void CheckpointParams::visit(ParameterVisitor& v) {
  v.text("file", file,
         "file that keeps the state for a restart after a crash; empty: none, and every start is a new one");
  v.text("launch_file", launch_file,
         "used instead while `file` is empty, for a manager that dies and is restarted; for one launch only, and "
         "rover.launch sets it");
  v.text("stop_file", stop_file,
         "file that keeps emergency stop and override until the operator ends them; empty: next to `file`, or in "
         "ROS_HOME if that is empty; none: not kept, they end with the process");
  v.number("interval_s", interval_s, {0.1, 3600.0}, "how often it is written, in sensor time [s]");
  v.number("max_age_s", max_age_s, {0.1, 1e6}, "an older one is not used [s]");
  v.number("speed_mps", speed_mps, {0.0, 100.0}, "1σ, on each axis, of the mean velocity while not running [m/s]");
  v.number("turn_rate_deg_per_s", turn_rate_deg_per_s, {0.0, 360.0},
           "1σ of the mean heading rate while not running [°/s]");
  v.number("tilt_deg_per_s", tilt_deg_per_s, {0.0, 360.0},
           "1σ of the mean rate of roll and pitch while not running [°/s]");
  v.number("max_turn_deg", max_turn_deg, {0.0, 60.0},
           "largest resulting 1σ of heading and tilt; the filter is linear in them [°]");
}

std::string formatCheckpoint(const Checkpoint& checkpoint) {
  const InitialState& state = checkpoint.state;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  text << kFormat << '\n';
  text << "stamp " << state.nav.stamp << '\n';
  text << "session " << checkpoint.session << '\n';
  const Quaternion& q = state.nav.q_b_to_n;
  writeLine("q_b_to_n", {q.w(), q.x(), q.y(), q.z()}, text);
  writeLine("v_eb_n", valuesOf(state.nav.v_eb_n), text);
  writeLine("position", valuesOf(state.nav.position), text);
  writeLine("accel_bias_b", valuesOf(state.nav.accel_bias_b), text);
  writeLine("gyro_bias_b", valuesOf(state.nav.gyro_bias_b), text);
  writeLine("imu_offset_b", valuesOf(state.nav.imu_offset_b), text);
  writeLine("vehicle", valuesOf(state.vehicle), text);
  writeLine("origin", valuesOf(state.origin), text);
  writeLine("standstill_variance", {state.standstill_variance}, text);
  writeLine("slip_hyperparameters", checkpoint.slip_hyperparameters, text);
  writeLine("covariance", valuesOf(state.P), text);
  return withChecksum(text.str());
}

std::string withChecksum(const std::string& body) { return body + "checksum " + checksumOf(body) + "\n"; }

Checkpoint parseCheckpoint(const std::string& text) {
  const Lines lines(checkedBody(text));
  Checkpoint checkpoint;
  InitialState& state = checkpoint.state;
  state.nav.stamp = lines.integer<Nanoseconds>("stamp");
  checkpoint.session = lines.integer<std::uint32_t>("session");
  const Values q = lines.numbers("q_b_to_n", 4);
  state.nav.q_b_to_n = Quaternion(q[0], q[1], q[2], q[3]);
  state.nav.v_eb_n = lines.vector("v_eb_n");
  state.nav.position = lines.position("position");
  state.nav.accel_bias_b = lines.vector("accel_bias_b");
  state.nav.gyro_bias_b = lines.vector("gyro_bias_b");
  state.nav.imu_offset_b = lines.vector("imu_offset_b");
  const Values vehicle = lines.numbers("vehicle", 6);
  state.vehicle = {vehicle[0], vehicle[1], vehicle[2], vehicle[3], vehicle[4], vehicle[5]};
  state.origin = lines.position("origin");
  state.standstill_variance = lines.numbers("standstill_variance", 1).front();
  checkpoint.slip_hyperparameters = lines.list("slip_hyperparameters", kMaxHyperparameters);
  const Values covariance = lines.numbers("covariance", kErrorStates * kErrorStates);
  state.P = Eigen::Map<const Eigen::Matrix<double, kErrorStates, kErrorStates, Eigen::RowMajor>>(covariance.data());
  checkState(state);
  return checkpoint;
}

void saveCheckpoint(const std::string& file, const Checkpoint& checkpoint) {
  AtomicFile writer(file);
  writer.stream() << formatCheckpoint(checkpoint);
  std::error_code none_before;
  std::filesystem::rename(file, previousOf(file), none_before);
  writer.commit();
}

LoadedCheckpoint loadCheckpoint(const std::string& file) {
  LoadedCheckpoint loaded;
  for (const std::string& path : {file, previousOf(file)}) {
    std::error_code ignored;
    if (loaded.checkpoint || !std::filesystem::exists(path, ignored)) {
      continue;
    }
    try {
      loaded.checkpoint = parseCheckpoint(readFile(path));
    } catch (const std::exception& error) {
      loaded.refused.push_back(path + ": " + error.what());
    }
  }
  return loaded;
}

void deleteCheckpoint(const std::string& file) {
  std::error_code none;
  std::filesystem::remove(file, none);
  std::filesystem::remove(previousOf(file), none);
}

InitialState resumeFrom(const Checkpoint& checkpoint, Nanoseconds now, const ErrorVector& prior_variance,
                        const CheckpointParams& params) {
  const double unwatched_s = toSeconds(now - checkpoint.state.nav.stamp);
  if (unwatched_s < 0.0 || unwatched_s > params.max_age_s) {
    refuse("is " + formatNumber(std::round(10.0 * unwatched_s) / 10.0) + " s old; checkpoint.max_age_s is " +
           formatNumber(params.max_age_s));
  }
  InitialState state = checkpoint.state;
  state.nav.stamp = now;
  state.nav.v_eb_n.setZero();
  for (int axis = 0; axis < 3; ++axis) {
    forgetError(kVelocity + axis, square(params.speed_mps), state.P);
  }
  for (const int slip : {kSlowSlip, kFastSlip, kSideSlip}) {
    forgetError(slip, prior_variance(slip), state.P);
  }
  state.vehicle.slow_slip = state.vehicle.fast_slip = state.vehicle.side_slip = 0.0;
  const double tilt_deg = std::min(params.tilt_deg_per_s * unwatched_s, params.max_turn_deg);
  const double turn_deg = std::min(params.turn_rate_deg_per_s * unwatched_s, params.max_turn_deg);
  state.P.diagonal().segment<2>(kAttitude).array() += square(degToRad(tilt_deg));
  state.P(kAttitude + 2, kAttitude + 2) += square(degToRad(turn_deg));
  state.P.diagonal().segment<3>(kPosition).array() += square(params.speed_mps * unwatched_s);
  return state;
}

}  // namespace slipnav
