#include "tuning/drive_likelihood.h"

#include <algorithm>
#include <cmath>

#include "slipnav/core/ekf/kalman_update.h"
#include "slipnav/core/navigation/pipeline.h"

namespace slipnav {
namespace {

constexpr double kTail = 0.001;

const std::array<double, kMaxMeasurementRows + 1>& gates() {
  static const std::array<double, kMaxMeasurementRows + 1> kGates = [] {
    std::array<double, kMaxMeasurementRows + 1> gates = {};
    for (int rows = 1; rows <= kMaxMeasurementRows; ++rows) {
      gates[static_cast<std::size_t>(rows)] = chiSquareQuantile(rows, kTail);
    }
    return gates;
  }();
  return kGates;
}

Nanoseconds beginOf(const TuningDrive& drive) {
  const auto imu = std::find_if(drive.samples.begin(), drive.samples.end(),
                                [](const Sample& sample) { return std::holds_alternative<ImuSample>(sample); });
  return imu == drive.samples.end() ? 0 : stampOf(*imu);
}

std::size_t stretchOf(Nanoseconds since_begin) {
  return static_cast<std::size_t>(std::max(0.0, toSeconds(since_begin) / kStretch_s));
}

Sample shifted(const Sample& sample, Nanoseconds earlier) {
  Sample result = sample;
  if (auto* wheels = std::get_if<WheelMotion>(&result)) {
    wheels->stamp -= earlier;
  }
  return result;
}

}  // namespace

double robustSquare(int rows, double squared) {
  const double gate = gates()[static_cast<std::size_t>(rows)];
  return squared <= gate ? squared : gate * (1.0 + std::log(squared / gate));
}

void InnovationSums::add(const InnovationSize& size) {
  const double counted = robustSquare(size.rows, size.squared);
  measurements += 1.0;
  rows += size.rows;
  squared += counted;
  log_likelihood -= 0.5 * (counted + size.log_determinant + size.rows * std::log(2.0 * kPi));
}

InnovationSums& InnovationSums::operator+=(const InnovationSums& other) {
  measurements += other.measurements;
  rows += other.rows;
  log_likelihood += other.log_likelihood;
  squared += other.squared;
  return *this;
}

std::size_t stretchCount(const TuningDrive& drive) {
  const Nanoseconds begin = beginOf(drive);
  Nanoseconds end = begin;
  for (const Sample& sample : drive.samples) {
    end = std::holds_alternative<ImuSample>(sample) ? std::max(end, stampOf(sample)) : end;
  }
  return stretchOf(end - begin) + 1;
}

DriveLikelihood likelihoodOf(const TuningDrive& drive, const Config& config, std::size_t stretches) {
  const Nanoseconds begin = beginOf(drive);
  const Nanoseconds end = begin + fromSeconds(static_cast<double>(stretches) * kStretch_s);
  const Nanoseconds earlier = fromSeconds(config.wheel.stamp_delay_s) - fromSeconds(drive.config.wheel.stamp_delay_s);
  DriveLikelihood likelihood(stretches);
  Pipeline pipeline(Planet::byName(config.planet), config.navigation(), [](const Estimate&, const ErrorCovariance&) {});
  pipeline.onInnovation([&](const Innovation& innovation) {
    const std::size_t stretch = stretchOf(innovation.stamp - begin);
    if (stretch < stretches) {
      likelihood[stretch][innovation.component].add(innovation.size);
    }
  });
  SampleMerger merger(config.filter.max_wait_s);
  const SampleMerger::Sink pass = [&pipeline](const Sample& sample) {
    std::visit([&pipeline](const auto& s) { pipeline.push(s); }, sample);
  };
  for (const Sample& sample : drive.samples) {
    if (std::holds_alternative<ImuSample>(sample) && stampOf(sample) >= end) {
      break;
    }
    merger.push(shifted(sample, earlier));
    merger.advance(pass);
  }
  merger.flush(pass);
  return likelihood;
}

}  // namespace slipnav
