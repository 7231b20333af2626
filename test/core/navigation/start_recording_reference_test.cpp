/// Rests and drives of all lengths before a start, with samples of all kinds, right and wrong: no change of what is
/// kept, or complained of, goes without being noticed.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "reference_trace.h"
#include "slipnav/core/navigation/direction_check.h"
#include "slipnav/core/navigation/input_check.h"
#include "slipnav/core/navigation/start_recording.h"

namespace slipnav::test {
namespace {

constexpr double kGravity_mps2 = 9.8;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Stands, drives on, and stands again, for seconds or minutes.
class Waiting {
 public:
  explicit Waiting(std::uint64_t seed) : dice_(seed) {}

  void addLine(ReferenceTrace& trace) {
    const bool at_rest = dice_.roll(5) < 3;
    const int count = dice_.from<int>({50, 150, 250, 260, 1000}) * (dice_.oneIn(12) ? 20 : 1);
    for (int i = 0; i < count; ++i) {
      push(at_rest, i);
    }
    if (dice_.oneIn(25)) {
      recording_.clear();
    }
    const Rest& rest = recording_.rest();
    trace.note(seconds(rest.begin), seconds(rest.end), rest.over, recording_.restIsLongEnough(),
               recording_.imu().size(), recording_.wheels().size(), recording_.fixes().size(),
               recording_.velocityFixes().size(), recording_.speedAt(now_ - 3 * kSecond), recording_.speedAt(now_));
    noteMeans(trace);
  }

 private:
  static double seconds(Nanoseconds stamp) { return toSeconds(stamp); }

  void noteMeans(ReferenceTrace& trace) {
    const ImuSample mean = recording_.mean(now_ - 2 * kSecond, now_);
    const ImuSample none = recording_.mean(now_, now_ + kSecond);
    trace.note("   mean", mean.f_ib_b.x(), mean.f_ib_b.z(), mean.omega_ib_b.z(), none.f_ib_b.z(),
               seconds(recording_.firstImuStampFrom(now_ - kSecond).value_or(0)),
               seconds(recording_.windowBeginFrom(now_ - 10 * kSecond, 0.02).value_or(0)));
  }

  void push(bool at_rest, int i) {
    now_ += dice_.oneIn(400) ? kSecond : kSecond / 50;
    const double shake = at_rest ? 0.0 : (i % 2 == 0 ? 1.0 : -1.0);
    const double bad = dice_.oneIn(150) ? kNan : 0.0;
    recording_.push(ImuSample{now_, {shake + 0.1 + bad, 0.0, -kGravity_mps2}, {0.0, 0.0, 0.2 * shake + 0.02}});
    if (dice_.oneIn(100)) {
      recording_.push(ImuSample{now_, {5.0, 0.0, 0.0}, Vector3::Zero()});
    }
    if (i % 5 == 4) {
      WheelMotion wheels;
      wheels.stamp = now_ - (dice_.oneIn(60) ? kSecond / 5 : 0);
      wheels.motion.forward_mps = (at_rest ? 0.0 : 0.5 + 0.001 * i) + (dice_.oneIn(60) ? kNan : 0.0);
      wheels.largest_speed_mps = at_rest ? 0.0 : 0.5;
      recording_.push(wheels);
      recording_.push(PositionFix{now_ - (dice_.oneIn(9) ? kSecond / 5 : 0), {0.7, bad, 0.0}, Vector3::Ones()});
      recording_.push(VelocityFix{now_ - (dice_.oneIn(9) ? kSecond / 5 : 0), {bad, 0.0, 0.0}, Vector3::Ones()});
    }
  }

  Dice dice_;
  Nanoseconds now_ = 100 * kSecond;
  StartRecording recording_{StationaryParams{},     ImuFloor{}, kGravity_mps2, 5.0, 12.0, Vector3(0.1, 0.0, 0.0),
                            Vector3(0.0, 0.0, 0.02)};
};

TEST(StartRecordingReference, KeepsTheSame) {
  ReferenceTrace trace("start_recording");
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Waiting waiting(seed);
    for (int line = 0; line < 40; ++line) {
      waiting.addLine(trace);
    }
  }
  trace.compare();
}

/// Sensors that are mounted, wired or scaled wrongly, or not: it changes every few seconds.
class WrongInput {
 public:
  explicit WrongInput(std::uint64_t seed) : dice_(seed) {}

  void addLine(ReferenceTrace& trace) {
    const double force = dice_.from<double>({1.0, 1.0, 1.0, 1.0 / 9.80665, 1.25, 0.75, 0.2, 0.4});
    const double tilt_rad = dice_.from<double>({0.0, 0.0, 0.0, 0.9, 1.2, 3.0});
    const double gyro = dice_.from<double>({1.0, 1.0, 1.0, 57.0, -1.0, 14.0, 16.0, -0.25, -0.5});
    const double wheel = dice_.from<double>({1.0, 1.0, -1.0});
    const bool has_sign = !dice_.oneIn(3);
    const int rest_samples = dice_.from<int>({40, 50, 100, 200});
    const double speed_mps = dice_.from<double>({0.5, 0.125, 0.25, -0.5});
    const int samples_per_wheel = dice_.from<int>({5, 5, 60});
    for (int i = 0; i < 350; ++i) {
      const double driven_s = 0.02 * std::max(0, i - rest_samples);
      const double v_mps = speed_mps * std::min(2.0 * driven_s, 1.0);
      const double yaw_radps = driven_s > 0.0 ? 0.5 : 0.0;
      const double rock_rad = driven_s > 0.0 ? 0.15 * std::sin(3.0 * driven_s) : 0.0;
      ImuSample imu{now_ += kSecond / 50, {}, {}};
      imu.f_ib_b = {driven_s > 0.0 && driven_s <= 0.5 ? 2.0 * speed_mps : 0.0, std::sin(tilt_rad + rock_rad), 0.0};
      imu.f_ib_b += Vector3(0.0, (kGravity_mps2 - 1.0) * std::sin(tilt_rad + rock_rad),
                            -kGravity_mps2 * std::cos(tilt_rad + rock_rad));
      imu.f_ib_b *= force;
      imu.omega_ib_b = gyro * Vector3(driven_s > 0.0 ? 0.45 * std::cos(3.0 * driven_s) : 0.0, 0.0, yaw_radps);
      spoilAndPush(imu);
      if (i % samples_per_wheel == 0) {
        WheelMotion wheels;
        wheels.stamp = now_;
        wheels.motion = {has_sign ? wheel * v_mps : std::abs(v_mps), yaw_radps, !dice_.oneIn(10)};
        wheels.largest_speed_mps = std::abs(v_mps);
        check_.push(wheels);
        direction_.push(wheels);
      }
    }
    trace.note(direction_.contradicts(), direction_.hasSign(), check_.complaint());
    if (dice_.oneIn(5)) {
      check_.reset();
    }
  }

 private:
  void spoilAndPush(ImuSample imu) {
    if (dice_.oneIn(40)) {
      imu.f_ib_b.y() = kNan;
    } else if (dice_.oneIn(40)) {
      imu.stamp -= kSecond / 50;
      imu.omega_ib_b.z() = 400.0;
    } else {
      direction_.push(imu);
    }
    check_.push(imu);
  }

  Dice dice_;
  Nanoseconds now_ = 100 * kSecond;
  InputCheck check_{kGravity_mps2, 0.0005};
  DirectionCheck direction_{0.0005};
};

TEST(InputCheckReference, ComplainsOfTheSame) {
  ReferenceTrace trace("input_check");
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    WrongInput input(seed);
    for (int line = 0; line < 12; ++line) {
      input.addLine(trace);
    }
  }
  trace.compare();
}

}  // namespace
}  // namespace slipnav::test
