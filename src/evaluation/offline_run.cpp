#include "evaluation/offline_run.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "core/slip/vehicle_slip.h"
#include "evaluation/forecast_judgement.h"
#include "evaluation/truth_gate.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/ekf/engine/filter_history.h"

namespace slipnav {
namespace {

Config withoutZeroUpdates(Config config) {
  std::vector<std::string>& updates = config.filter.updates;
  updates.erase(std::remove_if(updates.begin(), updates.end(),
                               [](const std::string& update) { return update == "zupt" || update == "zaru"; }),
                updates.end());
  return config;
}

Geodetic startingPlace(const InitializationParams& start) {
  return {degToRad(start.latitude_deg), degToRad(start.longitude_deg), start.height_m};
}

}  // namespace

OfflineRun::OfflineRun(const Config& config, bool with_baselines)
    : config_(config),
      planet_(Planet::byName(config.planet)),
      pipeline_(planet_, config.navigation(),
                [this](const Estimate& estimate, const ErrorCovariance& P) { record(estimate, P); }),
      stops_(config.stationary, imuFloor(config.imu.noise),
             planet_.gravity_n(startingPlace(config.initialization)).norm()) {
  if (with_baselines) {
    without_zupt_ = std::make_unique<OfflineRun>(withoutZeroUpdates(config), false);
    forecasts_.emplace(config);
  }
}

void OfflineRun::smoothAfterwards() {
  history_ = std::make_shared<FilterHistory>(planet_);
  pipeline_.keepHistory(history_);
}

void OfflineRun::push(const ImuSample& sample) {
  stops_.add(sample);
  pipeline_.push(sample);
  if (wheel_only_) {
    wheel_only_->addImu(sample);
  } else {
    earlier_imu_.push_back(sample);
  }
  if (without_zupt_) {
    without_zupt_->push(sample);
  }
}

void OfflineRun::push(const WheelMotion& wheels) {
  stops_.add(wheels);
  pipeline_.push(wheels);
  const SpeedSample speed{wheels.stamp, wheels.motion.forward_mps};
  if (wheel_only_) {
    wheel_only_->addSpeed(speed);
  } else {
    earlier_speeds_.push_back(speed);
  }
  if (without_zupt_) {
    without_zupt_->push(wheels);
  }
}

void OfflineRun::push(const AntennaFix& fix) {
  pipeline_.push(fix);
  if (without_zupt_) {
    without_zupt_->push(fix);
  }
}

void OfflineRun::setTruth(const NavigationState& truth, bool has_attitude) {
  pipeline_.setTruth(truth, has_attitude);
  if (without_zupt_) {
    without_zupt_->setTruth(truth, has_attitude);
  }
}

void OfflineRun::record(const Estimate& estimate, const ErrorCovariance& P) {
  if (!output_ || estimate.first) {  // a new start, also after the clock went back
    output_.emplace(planet_, pipeline_.initial()->origin, -config_.imu.mount.position_b(),
                    pipeline_.filter().dynamics().gyroNoiseDensity());
    estimates_.clear();
    filter_rows_.clear();
    if (forecasts_) {
      forecasts_->clear();
    }
    startWheelOnly(output_->make(estimate, P));
  }
  if (estimate.has_wheels) {
    slip_ = meanSlip(estimate);
  }
  const std::uint64_t zero_updates = pipeline_.filter().status(kZeroVelocity).accepted;
  if (zero_updates > zero_updates_) {
    stops_.noteZeroUpdate(estimate.nav.stamp);
  }
  zero_updates_ = zero_updates;
  filter_rows_.add(estimate, P, pipeline_.filter());
  const Output out = output_->make(estimate, P);
  if (on_output_) {
    on_output_(out);
  }
  estimates_.push_back({out.stamp, out.position_enu_m, out.pose_covariance.topLeftCorner<3, 3>(), out.q_flu_to_enu,
                        out.velocity_flu_mps.x(), slip_, estimate.stationary});
  if (on_estimate_) {
    on_estimate_(estimate, P);
  }
  if (forecasts_) {
    forecasts_->push(estimate, P, on_forecast_);
  }
}

/// Samples received before the start was known still count: it may precede them.
void OfflineRun::startWheelOnly(const Output& out) {
  const Vector3 forward_enu = out.q_flu_to_enu * Vector3::UnitX();
  wheel_only_.emplace();
  wheel_only_->start(
      {out.stamp, out.position_enu_m.x(), out.position_enu_m.y(), std::atan2(forward_enu.x(), forward_enu.y())});
  for (const ImuSample& sample : earlier_imu_) {
    wheel_only_->addImu(sample);
  }
  for (const SpeedSample& speed : earlier_speeds_) {
    wheel_only_->addSpeed(speed);
  }
  earlier_imu_.clear();
  earlier_speeds_.clear();
}

TruthTrack OfflineRun::truthTrack(const TruthAlignment& alignment, const EstimateTrack& estimates,
                                  MetricsInput& input) const {
  const TruthTrack whole =
      truth_poses_.empty() ? TruthTrack::fromFixes(truth_fixes_, output_->frame()) : TruthTrack(truth_poses_);
  if (whole.empty()) {
    return whole;
  }
  requireTimeInCommon(whole, estimates);
  TruthTrack truth = withoutJumps(whole);
  input.truth_left_out = static_cast<std::int64_t>(whole.samples().size() - truth.samples().size());
  if (alignment.at_start) {
    truth = alignAtStart(truth, estimates, *alignment.at_start);
  }
  const Vector3 lever_flu(config_.truth_mount.x_m, config_.truth_mount.y_m, config_.truth_mount.z_m);
  if (!lever_flu.isZero()) {
    truth = removeLeverArm(truth, estimates, lever_flu);
  }
  return alignment.heading_distance_m ? alignHeading(truth, estimates, *alignment.heading_distance_m) : truth;
}

/// Slip of the smoothed speed relative to the wheel speed in the last interval.
EstimateTrack OfflineRun::smoothedTrack() const {
  EstimateTrack track;
  auto filtered = estimates_.begin();
  auto wheels = filter_rows_.rows().begin();
  std::optional<double> wheel_speed_mps;
  for (const SmoothedState& epoch : history_->smooth()) {
    const Nanoseconds stamp = epoch.nav.stamp;
    filtered = std::find_if(filtered, estimates_.end(), [stamp](const auto& e) { return e.stamp >= stamp; });
    for (; wheels != filter_rows_.rows().end() && wheels->stamp <= stamp; ++wheels) {
      wheel_speed_mps = wheels->wheel_speed_mps;
    }
    Estimate estimate;
    estimate.nav = epoch.nav;
    estimate.vehicle = epoch.vehicle;
    estimate.omega_ib_b = epoch.omega_ib_b;
    const Output out = output_->make(estimate, epoch.P);
    const double speed_mps = out.velocity_flu_mps.x();
    const bool stationary = filtered != estimates_.end() && filtered->stationary;
    const bool slips = wheel_speed_mps && !stationary;
    track.push_back({stamp, out.position_enu_m, out.pose_covariance.topLeftCorner<3, 3>(), out.q_flu_to_enu, speed_mps,
                     slips ? slipRatio(speed_mps, *wheel_speed_mps) : std::nullopt, stationary});
  }
  return track;
}

/// Truth that is aligned with an estimate is aligned with this one.
SmoothedRun OfflineRun::smoothed(const TruthAlignment& alignment, const Metrics& filtered) const {
  SmoothedRun run;
  MetricsInput input;
  run.estimates = smoothedTrack();
  run.truth = truthTrack(alignment, run.estimates, input);
  input.estimates = run.estimates;
  input.truth = run.truth;
  run.metrics = computeMetrics(input);
  run.metrics.stop_count = filtered.stop_count;
  run.metrics.stop_rate_pct = filtered.stop_rate_pct;
  return run;
}

RunReport OfflineRun::finish(const TruthAlignment& alignment) const {
  if (!hasEstimates()) {
    throw std::runtime_error(failure());
  }
  RunReport report;
  MetricsInput input;
  report.estimates = estimates_;
  report.truth = truthTrack(alignment, estimates_, input);
  input.estimates = estimates_;
  input.truth = report.truth;
  input.wheel_only = wheel_only_->track();
  const SampleCounts& counts = pipeline_.counts();
  input.counters.imu_samples = static_cast<std::int64_t>(counts.imu);
  input.counters.wheel_samples = static_cast<std::int64_t>(counts.wheels);
  input.counters.rejected_samples = static_cast<std::int64_t>(counts.rejected);
  if (without_zupt_ && !without_zupt_->estimates_.empty()) {
    MetricsInput plain;
    plain.estimates = without_zupt_->estimates_;
    plain.truth = report.truth;
    input.no_zupt_error_pct = computeMetrics(plain).enu_error_pct;
  }
  if (forecasts_) {
    report.forecasts = forecasts_->errorRows();
    report.diagnostics.slip_forecasts = forecasts_->slipRows();
    input.counters.forecast_ms = forecasts_->times_ms();
    input.counters.forecasts = static_cast<std::int64_t>(forecasts_->times_ms().size());
  }
  input.stops = stops_.counts(estimates_.front().stamp, estimates_.back().stamp);
  input.uses_stops = config_.filter.uses("zupt");
  input.largest_nis = largestNis(filter_rows_.rows());
  report.metrics = computeMetrics(input);
  if (forecasts_) {
    report.metrics.threshold_m = config_.forecast.threshold_m;
    judgeForecasts(report.forecasts, report.estimates, report.truth, report.metrics);
  }
  report.metrics.alarms = pipeline_.health().alarms();
  report.diagnostics.filter = filter_rows_.rows();
  report.diagnostics.wheel_only = input.wheel_only;
  if (history_) {
    report.smoothed = smoothed(alignment, report.metrics);
  }
  return report;
}

}  // namespace slipnav
