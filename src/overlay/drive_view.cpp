#include "overlay/drive_view.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace slipnav {
namespace {

/// Shorter distances are not counted, so that the vibration of a standing rover adds nothing.
constexpr double kDistanceStep_m = 0.05;
constexpr double kSigmas = 3.0;
/// A step that exceeds what the speed explains by this much was not driven: the estimate was moved.
constexpr double kPoseOverride_m = 0.5;

bool isPlacement(const EstimateSample& before, const EstimateSample& now) {
  const double speed_mps = std::max(std::abs(before.speed_mps), std::abs(now.speed_mps));
  const double driven_m = speed_mps * toSeconds(now.stamp - before.stamp);
  return (now.position_enu_m - before.position_enu_m).norm() > driven_m + kPoseOverride_m;
}

/// Planar dead reckoning has no height; it uses that of the estimate.
TrackPoint pointOf(const PlanarSample& pose, double height_m) {
  const Quaternion heading(Eigen::AngleAxisd(0.5 * kPi - pose.heading_rad, Vector3::UnitZ()));
  return {pose.stamp, {pose.east_m, pose.north_m, height_m}, heading, std::nullopt};
}

PlanarSample planarPose(const EstimateSample& estimate) {
  const Vector3 forward_enu = estimate.q_flu_to_enu * Vector3::UnitX();
  return {estimate.stamp, estimate.position_enu_m.x(), estimate.position_enu_m.y(),
          std::atan2(forward_enu.x(), forward_enu.y())};
}

}  // namespace

DriveView::DriveView(const OverlayParams& params, const TruthParams& truth, const Vector3& truth_lever_flu_m)
    : flat_(params.flat),
      track_(params.point_spacing_m, static_cast<std::size_t>(params.max_points)),
      truth_(params.point_spacing_m, static_cast<std::size_t>(params.max_points)),
      wheels_(params.point_spacing_m, static_cast<std::size_t>(params.max_points)),
      stops_(static_cast<std::size_t>(params.max_stops)),
      truth_follower_(truth, truth_lever_flu_m) {}

void DriveView::clearDrive() {
  track_.clear();
  truth_.clear();
  wheels_.clear();
  stops_.clear();
  course_.clear();
  wheel_poses_.clear();
  newest_.reset();
  pair_.reset();
  slip_.reset();
  stationary_ = false;
  distance_m_ = 0.0;
  ++revision_;
}

void DriveView::clear() {
  clearDrive();
  start_.reset();
}

void DriveView::start(const LocalFrame& frame, Nanoseconds stamp) {
  clearDrive();
  if (wheel_path_.started()) {  // a new start without a new clock
    wheel_path_.clear();
  }
  start_ = stamp;
  truth_follower_.start(frame, stamp);
}

void DriveView::add(const EstimateSample& estimate) {
  if (!start_ || estimate.stamp < *start_) {
    return;
  }
  if (newest_ && estimate.stamp <= newest_->stamp - kRestartBackstep) {
    clearDrive();
  }
  if (newest_ && estimate.stamp <= newest_->stamp) {
    return;
  }
  if (!newest_) {
    distance_mark_enu_m_ = estimate.position_enu_m;
    wheel_path_.start(planarPose(estimate));
  }
  if (newest_ && isPlacement(*newest_, estimate)) {
    distance_mark_enu_m_ = estimate.position_enu_m;
  }
  const double step_m = (estimate.position_enu_m - distance_mark_enu_m_).norm();
  if (step_m >= kDistanceStep_m) {
    distance_m_ += step_m;
    distance_mark_enu_m_ = estimate.position_enu_m;
  }
  track_.add({estimate.stamp, estimate.position_enu_m, estimate.q_flu_to_enu, slip_});
  course_.add(estimate.stamp, estimate.position_enu_m, estimate.q_flu_to_enu * Vector3(estimate.speed_mps, 0.0, 0.0));
  takeTruth(newest_.value_or(estimate), estimate);
  newest_ = estimate;
  takeWheelPath();
  ++revision_;
}

void DriveView::takeTruth(const EstimateSample& earlier, const EstimateSample& later) {
  for (const TruthPair& pair : truth_follower_.follow(earlier, later)) {
    TrackPoint point{pair.truth.stamp, pair.truth.position_enu_m, pair.estimate.q_flu_to_enu, std::nullopt};
    if (flat_) {
      point.position_enu_m.z() = pair.estimate.position_enu_m.z();
    }
    truth_.add(point);
    pair_ = pair;
  }
}

void DriveView::takeWheelPath() {
  for (const PlanarSample& pose : wheel_path_.take()) {
    wheel_poses_.push_back(pose);
  }
  while (!wheel_poses_.empty() && wheel_poses_.front().stamp <= newest_->stamp) {
    wheels_.add(pointOf(wheel_poses_.front(), newest_->position_enu_m.z()));
    wheel_poses_.pop_front();
  }
}

void DriveView::addSlip(Nanoseconds stamp, std::optional<double> slip, bool stationary) {
  slip_ = slip;
  stationary_ = stationary;
  if (newest_) {
    stops_.add(stamp, stationary, newest_->position_enu_m, {horizontalError(), horizontalBound()});
  }
  ++revision_;
}

double DriveView::horizontalBound() const {
  if (!newest_) {
    return 0.0;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(newest_->covariance_enu_m2.topLeftCorner<2, 2>(),
                                                            Eigen::EigenvaluesOnly);
  return kSigmas * std::sqrt(std::max(0.0, axes.eigenvalues()(1)));
}

std::optional<double> DriveView::horizontalError() const {
  if (!pair_) {
    return std::nullopt;
  }
  return (pair_->estimate.position_enu_m - pair_->truth.position_enu_m).head<2>().norm();
}

}  // namespace slipnav
