/// The grounds differ as the paper's do: by slip, and by how far wheel dead reckoning goes astray.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulation/driver.h"
#include "simulation/simulator.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav::sim {
namespace {

struct DriveStatistics {
  double mean_slip = 0.0;
  double slip_sigma = 0.0;
  double max_slip = 0.0;
  double side_slip_sigma_deg = 0.0;
  double initial_side_slip_deg = 0.0;  ///< largest while driving straight to initialize
  double initial_slip = 0.0;           ///< mean over the same
  double dead_reckoning_pct = 0.0;     ///< final error of two-dimensional wheel odometry over the distance
};

/// Mean wheel speed along the integrated vertical gyro, less its mean over the initial rest; nominal wheel radius.
class DeadReckoning {
 public:
  void addImu(const ImuSample& imu, double dt_s, bool resting) {
    if (resting) {
      rest_sum_ += imu.omega_ib_b.z();
      ++rest_count_;
    } else {
      heading_rad_ += dt_s * (imu.omega_ib_b.z() - rest_sum_ / rest_count_);
    }
  }

  void addWheels(const WheelSample& wheel, double radius_m, double dt_s) {
    double rate = 0.0;
    for (std::size_t i = 0; i < wheel.count; ++i) {
      rate += wheel.rate_radps[i] / static_cast<double>(wheel.count);
    }
    const double mean_heading_rad = 0.5 * (heading_rad_ + last_heading_rad_);
    place_ += dt_s * radius_m * rate * Vector2(std::sin(mean_heading_rad), std::cos(mean_heading_rad));
    last_heading_rad_ = heading_rad_;
  }

  void restart(const TruthState& truth) {
    place_ = truth.position_enu_m.head<2>();
    heading_rad_ = last_heading_rad_ = eulerFrom_q_b_to_n(truth.q_b_to_n).z();
  }

  const Vector2& place() const { return place_; }

 private:
  Vector2 place_ = Vector2::Zero();
  double heading_rad_ = 0.0;
  double last_heading_rad_ = 0.0;
  double rest_sum_ = 0.0;
  double rest_count_ = 0.0;
};

/// Running mean and spread.
struct Moments {
  void add(double x) {
    sum += x;
    sum2 += x * x;
    count += 1.0;
  }
  double mean() const { return sum / count; }
  double sigma() const { return std::sqrt(sum2 / count - mean() * mean()); }

  double sum = 0.0;
  double sum2 = 0.0;
  double count = 0.0;
};

DriveStatistics statisticsOf(const std::string& terrain, int seed, double distance_m) {
  SimulatorParams params;
  params.terrain = terrain;
  params.seed = seed;
  params.drive.distance_m = distance_m;
  RoverSimulator rover(params, Planet::byName("earth"));
  Driver driver(params);
  DriveStatistics out;
  DeadReckoning reckoning;
  Moments slip;
  Moments side_slip;
  Moments initial_slip;
  double route_start_m = -1.0;
  bool moved = false;
  while (!driver.finished()) {
    const Measurements m = rover.step(driver.command(rover.truth()));
    const TruthState& truth = rover.truth();
    moved = moved || !truth.standstill;
    reckoning.addImu(m.imu, 1.0 / params.imu.rate_hz, !moved);
    if (m.wheel) {
      reckoning.addWheels(*m.wheel, params.vehicle.wheel_radius_m, 1.0 / params.encoder.rate_hz);
    }
    const bool on_route = driver.initializationDriveDone();
    if (on_route && route_start_m < 0.0) {
      route_start_m = truth.distance_m;
      reckoning.restart(truth);
    }
    if (truth.v_eb_b.x() > 0.1) {
      for (const double wheel_slip : truth.slip) {
        (on_route ? slip : initial_slip).add(wheel_slip);
        out.max_slip = std::max(out.max_slip, wheel_slip);
      }
      const double side_slip_deg = radToDeg(truth.slip_angle_rad);
      side_slip.add(side_slip_deg);
      if (!on_route) {
        out.initial_side_slip_deg = std::max(out.initial_side_slip_deg, std::abs(side_slip_deg));
      }
    }
  }
  out.mean_slip = slip.mean();
  out.slip_sigma = slip.sigma();
  out.side_slip_sigma_deg = side_slip.sigma();
  out.initial_slip = initial_slip.mean();
  const Vector2 end = rover.truth().position_enu_m.head<2>();
  out.dead_reckoning_pct = 100.0 * (reckoning.place() - end).norm() / (rover.truth().distance_m - route_start_m);
  return out;
}

std::vector<DriveStatistics> drives(const std::string& terrain, int count, double distance_m) {
  std::vector<DriveStatistics> all;
  for (int seed = 1; seed <= count; ++seed) {
    all.push_back(statisticsOf(terrain, seed, distance_m));
  }
  return all;
}

double medianOf(std::vector<DriveStatistics> all, double DriveStatistics::*field) {
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end(),
                   [&](const DriveStatistics& a, const DriveStatistics& b) { return a.*field < b.*field; });
  return (*middle).*field;
}

TEST(SimStatistics, RoughGroundIsThePapersAshPile) {
  const std::vector<DriveStatistics> all = drives("rough", 11, 650.0);
  EXPECT_NEAR(medianOf(all, &DriveStatistics::mean_slip), 0.10, 0.02);
  EXPECT_GT(medianOf(all, &DriveStatistics::max_slip), 0.5);
  EXPECT_NEAR(medianOf(all, &DriveStatistics::slip_sigma), 0.11, 0.03);
  EXPECT_NEAR(medianOf(all, &DriveStatistics::side_slip_sigma_deg), 1.5, 0.5);
  EXPECT_GE(medianOf(all, &DriveStatistics::dead_reckoning_pct), 8.0);
  EXPECT_LE(medianOf(all, &DriveStatistics::dead_reckoning_pct), 14.0);
}

TEST(SimStatistics, BenignGroundsSlipLessTheFirmerTheyAre) {
  const std::vector<DriveStatistics> paved = drives("paved", 5, 300.0);
  EXPECT_NEAR(medianOf(paved, &DriveStatistics::mean_slip), 0.005, 0.003);
  EXPECT_LT(medianOf(paved, &DriveStatistics::slip_sigma), 0.03);
  EXPECT_LT(medianOf(paved, &DriveStatistics::dead_reckoning_pct), 3.0);
  const std::vector<DriveStatistics> unpaved = drives("unpaved", 5, 300.0);
  EXPECT_NEAR(medianOf(unpaved, &DriveStatistics::mean_slip), 0.02, 0.007);
  const std::vector<DriveStatistics> gravel = drives("gravel", 5, 300.0);
  EXPECT_NEAR(medianOf(gravel, &DriveStatistics::mean_slip), 0.055, 0.01);
  EXPECT_LT(medianOf(unpaved, &DriveStatistics::dead_reckoning_pct),
            medianOf(gravel, &DriveStatistics::dead_reckoning_pct));
}

TEST(SimStatistics, InitializationDriveHardlySlips) {
  for (const DriveStatistics& drive : drives("rough", 20, 1.0)) {
    EXPECT_LT(std::abs(drive.initial_slip), 0.003);
    EXPECT_LT(drive.initial_side_slip_deg, 0.05);
  }
}

}  // namespace
}  // namespace slipnav::sim
