#include "monte_carlo.h"

#include <Eigen/LU>
#include <cmath>
#include <deque>
#include <future>
#include <stdexcept>

#include "evaluation/simulated_drive.h"

namespace slipnav::test {
namespace {

/// Compares estimates with the truth of the same stamp.
class Judge {
 public:
  Judge(const Planet& planet, const Vector3& imu_position_b) : planet_(planet), imu_position_b_(imu_position_b) {}

  void addTruth(const sim::TruthState& truth) { truths_.push_back(truth); }

  void compare(const Estimate& estimate, const ErrorCovariance& P) {
    while (!truths_.empty() && truths_.front().stamp < estimate.nav.stamp) {
      truths_.pop_front();
    }
    if (truths_.empty() || truths_.front().stamp != estimate.nav.stamp) {
      throw std::logic_error("no truth for an estimate");
    }
    const sim::TruthState& truth = truths_.front();
    const ErrorVector error = errorBetween(planet_, estimate.nav, toNavState(truth, planet_, imu_position_b_));
    if (first_ == 0) {
      first_ = truth.stamp;
      start_m_ = truth.distance_m;
    }
    const Vector3 position = error.segment<3>(kPosition);
    sum_square_ += position.cwiseAbs2();
    for (int i = 0; i < 3; ++i) {
      covered_ += std::abs(position(i)) <= 3.0 * std::sqrt(P(kPosition + i, kPosition + i)) ? 1 : 0;
    }
    ++count_;
    const double minutes = toSeconds(truth.stamp - first_) / 60.0;
    if (minutes >= static_cast<double>(result.by_minute.size() + 1)) {
      result.by_minute.push_back({nees(error, P, kAttitude), nees(error, P, kVelocity), nees(error, P, kPosition)});
    }
    result.distance_m = truth.distance_m - start_m_;
    result.final_error_pct = 100.0 * position.head<2>().norm() / std::max(result.distance_m, 1.0);
    result.final_error = error;
    result.final_sigma = P.diagonal().cwiseSqrt();
  }

  void finish() {
    const Vector3 rms = (sum_square_ / count_).cwiseSqrt();
    result.enu_error_pct = 100.0 * rms.norm() / result.distance_m;
    result.coverage_3sigma_pct = 100.0 * covered_ / (3.0 * count_);
  }

  DriveResult result;

 private:
  static double nees(const ErrorVector& error, const ErrorCovariance& P, int index) {
    const Vector3 e = error.segment<3>(index);
    const Matrix3 block = P.block<3, 3>(index, index);
    return e.dot(block.inverse() * e);
  }

  Planet planet_;
  Vector3 imu_position_b_;
  std::deque<sim::TruthState> truths_;
  Nanoseconds first_ = 0;
  double start_m_ = 0.0;
  Vector3 sum_square_ = Vector3::Zero();
  double covered_ = 0.0;
  double count_ = 0.0;
};

/// What the sensors say `time_s` after the disturbance began.
void pushDisturbed(const Disturbance& disturbance, double time_s, sim::Measurements measurements,
                   const WheelGeometry& geometry, Pipeline& pipeline) {
  const Nanoseconds shift = fromSeconds(disturbance.clock_jump_s);
  measurements.imu.stamp += shift;
  if (measurements.wheel) {
    measurements.wheel->stamp += shift;
  }
  if (time_s < disturbance.wheel_gap_s) {
    measurements.wheel.reset();
  }
  if (time_s >= disturbance.imu_gap_s) {
    pushMeasurements(measurements, geometry, pipeline);
  } else if (measurements.wheel) {
    pipeline.push(toWheelMotion(geometry, *measurements.wheel));
  }
}

}  // namespace

DriveResult runDrive(const Config& config, const std::string& policy, const Disturbance& disturbance) {
  const Planet planet = Planet::byName(config.planet);
  const WheelGeometry geometry = config.wheelGeometry();
  Judge judge(planet, config.imu.mount.position_b());
  Pipeline pipeline(planet, config.navigation(),
                    [&judge](const Estimate& estimate, const ErrorCovariance& P) { judge.compare(estimate, P); });
  const std::unique_ptr<StopPolicy> stops = makeStopPolicy(policy, config.stop);
  Nanoseconds begin = 0;
  simulateDrive(config.simulator, planet, *stops, [&](const sim::Measurements& measurements, sim::TruthState truth) {
    begin = begin == 0 && pipeline.initial() ? truth.stamp : begin;
    const double time_s = toSeconds(truth.stamp - begin) - disturbance.begin_s;
    const bool is_disturbed = begin != 0 && time_s >= 0.0;
    truth.stamp += is_disturbed ? fromSeconds(disturbance.clock_jump_s) : 0;
    judge.addTruth(truth);
    if (config.initialization.source == "truth" && !pipeline.initial() && truth.distance_m > 12.0) {
      pipeline.setTruth(toNavState(truth, planet, config.imu.mount.position_b()), true);
    }
    if (is_disturbed) {
      pushDisturbed(disturbance, time_s, measurements, geometry, pipeline);
    } else {
      pushMeasurements(measurements, geometry, pipeline);
    }
  });
  if (!pipeline.initial()) {
    throw std::runtime_error("not initialized: " + pipeline.initializer().progress());
  }
  judge.finish();
  for (int i = 0; i < kComponents; ++i) {
    judge.result.components[static_cast<std::size_t>(i)] = pipeline.filter().status(static_cast<Component>(i));
  }
  return judge.result;
}

std::vector<DriveResult> runDrives(int count, const std::function<DriveResult(int drive)>& run) {
  const auto everySecond = [count, &run](int first) {
    std::vector<DriveResult> results;
    for (int drive = first; drive <= count; drive += 2) {
      results.push_back(run(drive));
    }
    return results;
  };
  std::future<std::vector<DriveResult>> odd = std::async(std::launch::async, everySecond, 1);
  std::vector<DriveResult> all = everySecond(2);
  for (const DriveResult& result : odd.get()) {
    all.push_back(result);
  }
  return all;
}

}  // namespace slipnav::test
