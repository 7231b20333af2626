/// Drives on which sensors fail in every way that is known: gaps, dead and spinning wheels, wrong numbers, clocks that
/// are set, satellite fixes that jump. No change of an estimate or an alarm goes without being noticed.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "recorded_drive.h"
#include "reference_trace.h"
#include "slipnav/core/navigation/pipeline.h"

namespace slipnav::test {
namespace {

/// Feeds a pipeline with a drive that a die spoils, second by second.
class FaultyDrive {
 public:
  FaultyDrive(const Config& config, const RecordedDrive& drive, std::uint64_t seed)
      : dice_(seed),
        drive_(drive),
        pipeline_(Planet::byName("earth"), config.navigation(),
                  [this](const Estimate& e, const ErrorCovariance& P) { add(e, P); }) {}

  void run(ReferenceTrace& trace) {
    Nanoseconds second = drive_.samples.front().stamp();
    for (const DriveSample& sample : drive_.samples) {
      if (sample.stamp() >= second) {
        second += kSecond;
        note(trace);
        fault_ = sample.stamp() > drive_.samples.front().stamp() + 8 * kSecond ? dice_.roll(26) : -1;
        offset_ += fault_ == 0 ? dice_.from<Nanoseconds>({2 * kSecond, 70 * kSecond, -3 * kSecond}) : 0;
      }
      sample.is_imu ? pushImu(sample.imu) : pushWheels(sample.wheels);
    }
    note(trace);
    for (const auto& [name, alarm] : pipeline_.health().alarms()) {
      trace.note(name, toSeconds(alarm.first - drive_.samples.front().stamp()),
                 toSeconds(alarm.last - drive_.samples.front().stamp()), alarm.count);
    }
    const SampleCounts& counts = pipeline_.counts();
    trace.note("counts", counts.imu, counts.wheels, counts.rejected, counts.gaps, counts.restarts);
  }

 private:
  void add(const Estimate& estimate, const ErrorCovariance& P) {
    const NavigationState& nav = estimate.nav;
    ++estimates_;
    flags_ += (estimate.first ? 1 : 0) + (estimate.stationary ? 2 : 0) + (estimate.stuck ? 4 : 0) +
              (estimate.wheel_speed_used ? 8 : 0) + (estimate.has_wheels ? 16 : 0);
    sums_(0) += nav.v_eb_n.norm() + nav.accel_bias_b.norm() + 100.0 * nav.gyro_bias_b.norm();
    sums_(1) += std::abs(nav.q_b_to_n.x()) + std::abs(nav.q_b_to_n.y()) + std::abs(nav.q_b_to_n.z());
    sums_(2) += std::abs(estimate.vehicle.slow_slip) + std::abs(estimate.vehicle.fast_slip);
    sums_(3) += estimate.noise_factors.wheel + estimate.noise_factors.fast_slip + estimate.noise_factors.slow_slip +
                estimate.noise_factors.lateral + estimate.noise_factors.vertical + estimate.noise_factors.side_slip;
    sums_.segment<4>(4) += Eigen::Vector4d(
        std::sqrt(P.diagonal().segment<3>(kAttitude).sum()), std::sqrt(P.diagonal().segment<3>(kVelocity).sum()),
        std::sqrt(P.diagonal().segment<3>(kPosition).sum()), std::sqrt(P.diagonal().tail<kErrorStates - 9>().sum()));
  }

  void note(ReferenceTrace& trace) {
    trace.note(fault_, estimates_, flags_, sums_(0), sums_(1), sums_(2), sums_(3), sums_(4), sums_(5), sums_(6),
               sums_(7), pipeline_.filter().recoveries(), pipeline_.filter().unexpectedSlips());
    estimates_ = flags_ = 0;
    sums_.setZero();
  }

  void pushImu(ImuSample imu) {
    const bool lost = fault_ == 1 || (fault_ == 2 && dice_.oneIn(3)) || (fault_ == 3 && dice_.oneIn(10));
    if (lost) {
      return;
    }
    imu.stamp += offset_;
    imu.f_ib_b.x() += fault_ == 4 ? 3.0 * dice_.normal() : fault_ == 5 ? 6.0 : 0.0;
    imu.omega_ib_b.x() += fault_ == 6 ? 1.0 : 0.0;
    if (fault_ == 7) {
      imu.omega_ib_b.y() = 0.125;
    } else if (fault_ == 8 && dice_.oneIn(4)) {
      imu.f_ib_b.y() = dice_.from<double>({std::numeric_limits<double>::quiet_NaN(), 1e6});
    }
    pipeline_.push(imu);
    if (++count_ % 10 == 0) {
      pushFixes(imu.stamp);
    }
  }

  void pushWheels(WheelMotion wheels) {
    if (fault_ == 9 || fault_ == 1 || (fault_ == 10 && dice_.oneIn(2))) {
      return;
    }
    wheels.stamp += offset_ - (fault_ == 11 ? kSecond / 20 : 0) + (fault_ == 12 ? 2 * kSecond : 0);
    const double factor = fault_ == 13 ? 1.7 : fault_ == 14 ? 0.3 : fault_ == 15 ? 4.0 : fault_ == 16 ? -1.0 : 1.0;
    wheels.motion.forward_mps *= factor;
    wheels.largest_speed_mps *= std::abs(factor);
    if (fault_ == 17) {
      wheels.motion.forward_mps = wheels.largest_speed_mps = 0.0;
      wheels.circumferential_mps.fill(0.0);
    } else if (fault_ == 18) {
      wheels.circumferential_mps[2] = 0.0;
    } else if (fault_ == 19) {
      wheels.motion.yaw_rate_radps += 0.7;
    } else if (fault_ == 20) {
      wheels.motion.forward_mps = std::numeric_limits<double>::quiet_NaN();
    }
    pipeline_.push(wheels);
    if (fault_ == 21) {
      pipeline_.push(wheels);
    }
  }

  void pushFixes(Nanoseconds stamp) {
    const NavigationState& nav = pipeline_.filter().state();
    if (!pipeline_.initial() || fault_ == 22) {
      return;
    }
    PositionFix fix{stamp, nav.position, Vector3(1.0, 1.0, 4.0)};
    fix.position.latitude_rad += 1e-7 * dice_.normal() + (fault_ == 23 ? 1e-4 : 0.0);
    fix.position.height_m += fault_ == 24 ? std::numeric_limits<double>::quiet_NaN() : dice_.normal();
    pipeline_.push(AntennaFix(fix));
  }

  Dice dice_;
  const RecordedDrive& drive_;
  Pipeline pipeline_;
  int fault_ = -1;
  Nanoseconds offset_ = 0;
  int count_ = 0;
  int estimates_ = 0;
  int flags_ = 0;
  Eigen::Matrix<double, 8, 1> sums_ = Eigen::Matrix<double, 8, 1>::Zero();
};

class FaultyDriveReference : public ::testing::TestWithParam<const char*> {};

TEST_P(FaultyDriveReference, EstimatesAndAlarmsAreTheSame) {
  const std::string terrain = GetParam();
  Config config = driveConfig(25.0);
  config.simulator.terrain = terrain;
  config.initialization.source = "given";
  config.initialization.leveling_window_s = 3.0;
  config.gnss.use = terrain == "paved" ? "always" : "start";
  const RecordedDrive drive = recordDrive(config);
  ReferenceTrace trace("faulty_drive_" + terrain);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    FaultyDrive(config, drive, seed).run(trace);
  }
  trace.compare();
}

INSTANTIATE_TEST_SUITE_P(Terrains, FaultyDriveReference, ::testing::Values("paved", "rough"));

}  // namespace
}  // namespace slipnav::test
