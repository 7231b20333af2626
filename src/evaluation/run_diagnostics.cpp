#include "evaluation/run_diagnostics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <iomanip>
#include <limits>

#include "core/base/atomic_file.h"
#include "io/fields.h"
#include "slipnav/core/navigation/output.h"

namespace slipnav {
namespace {

/// Enough for plots.
constexpr int kDigits = 8;

/// One outlier of many sigma must not decide.
constexpr double kMostOfOne = 100.0;
constexpr double kLeastMeasurements = 50.0;

Vector3 sigmas(const ErrorCovariance& P, int first) { return P.diagonal().segment<3>(first).cwiseMax(0.0).cwiseSqrt(); }

}  // namespace

void FilterRecorder::add(const Estimate& estimate, const ErrorCovariance& P, const FilterEngine& filter) {
  if (!estimate.has_wheels) {
    return;
  }
  FilterRow row;
  row.stamp = estimate.nav.stamp;
  row.wheel_speed_mps = estimate.wheels.motion.forward_mps;
  row.accel_bias_flu_mps2 = swapFrdFlu(estimate.nav.accel_bias_b);
  row.accel_sigma_mps2 = sigmas(P, kAccelBias);
  row.gyro_bias_flu_radps = swapFrdFlu(estimate.nav.gyro_bias_b);
  row.gyro_sigma_radps = sigmas(P, kGyroBias);
  for (std::size_t i = 0; i < row.nis.size(); ++i) {
    const ComponentStatus& status = filter.status(static_cast<Component>(i));
    if (status.accepted + status.rejected > measured_[i]) {
      row.nis[i] = status.last_nis;
    }
    measured_[i] = status.accepted + status.rejected;
  }
  rows_.push_back(row);
}

std::optional<LargestNis> largestNis(const std::vector<FilterRow>& rows) {
  std::optional<LargestNis> largest;
  for (std::size_t i = 0; i < kComponents; ++i) {
    double sum = 0.0;
    double count = 0.0;
    for (const FilterRow& row : rows) {
      sum += row.nis[i] ? std::min(*row.nis[i], kMostOfOne) : 0.0;
      count += row.nis[i] ? 1.0 : 0.0;
    }
    if (count >= kLeastMeasurements && (!largest || sum / count > largest->mean)) {
      largest = LargestNis{componentName(static_cast<Component>(i)), sum / count};
    }
  }
  return largest;
}

void writeFilterCsv(const std::string& path, const std::vector<FilterRow>& rows) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "t,wheel_speed";
  for (const char* quantity : {"accel_bias", "accel_sigma", "gyro_bias", "gyro_sigma"}) {
    for (const char* axis : {"x", "y", "z"}) {
      out << ',' << quantity << '_' << axis;
    }
  }
  for (int i = 0; i < kComponents; ++i) {
    out << ",nis_" << componentName(static_cast<Component>(i));
  }
  out << '\n' << std::setprecision(kDigits);
  for (const FilterRow& row : rows) {
    out << formatSeconds(row.stamp) << ',' << row.wheel_speed_mps;
    for (const Vector3& v :
         {row.accel_bias_flu_mps2, row.accel_sigma_mps2, row.gyro_bias_flu_radps, row.gyro_sigma_radps}) {
      writeVector(out, v);
    }
    for (const std::optional<double>& nis : row.nis) {
      out << ',' << nis.value_or(std::numeric_limits<double>::quiet_NaN());
    }
    out << '\n';
  }
  file.commit();
}

void writeWheelTrackCsv(const std::string& path, const PlanarTrack& track) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "t,east,north\n" << std::setprecision(kDigits);
  for (const PlanarSample& pose : track) {
    out << formatSeconds(pose.stamp) << ',' << pose.east_m << ',' << pose.north_m << '\n';
  }
  file.commit();
}

void writeSlipForecastsCsv(const std::string& path, const std::vector<SlipForecastRow>& rows) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "t,horizon_s,mean,stddev,wheel_speed,wheel_speed_above,wheel_speed_below\n" << std::setprecision(kDigits);
  for (const SlipForecastRow& row : rows) {
    out << formatSeconds(row.stamp) << ',' << row.horizon_s << ',' << row.mean << ',' << row.stddev;
    for (const double speed_mps : row.wheel_speed_mps) {
      out << ',' << speed_mps;
    }
    out << '\n';
  }
  file.commit();
}

void writeNeesCsv(const std::string& path, const EstimateTrack& estimates, const TruthTrack& truth) {
  AtomicFile file(path);
  std::ostream& out = file.stream();
  out << "t,nees,truth_sigma_e,truth_sigma_n,truth_sigma_u\n" << std::setprecision(kDigits);
  for (const TruthSample& sample : truth.samples()) {
    const auto estimate = interpolate(estimates, sample.stamp, truth.maxGap());
    if (!estimate) {
      continue;
    }
    const Eigen::LLT<Matrix3> factor(estimate->covariance_enu_m2 + sample.covariance_enu_m2);
    if (factor.info() == Eigen::Success) {
      const Vector3 error = estimate->position_enu_m - sample.position_enu_m;
      out << formatSeconds(sample.stamp) << ',' << error.dot(factor.solve(error));
      writeVector(out, sample.covariance_enu_m2.diagonal().cwiseMax(0.0).cwiseSqrt());
      out << '\n';
    }
  }
  file.commit();
}

}  // namespace slipnav
