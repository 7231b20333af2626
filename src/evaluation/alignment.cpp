#include "evaluation/alignment.h"

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace slipnav {
namespace {

/// Smallest horizontal extent of truth that determines a heading.
constexpr double kMinExtentM = 1.0;

/// Angle about z of the rotation closest to q in terms of the x axis seen from above.
double yaw(const Quaternion& q) {
  const Vector3 forward = q * Vector3::UnitX();
  return std::atan2(forward.y(), forward.x());
}

Quaternion rotationAboutUp(double angle_rad) { return Quaternion(Eigen::AngleAxisd(angle_rad, Vector3::UnitZ())); }

/// Rotates truth about `pivot_m`, then shifts it by `shift_m`.
TruthTrack moveRigidly(const TruthTrack& truth, const Quaternion& rotation, const Vector3& pivot_m,
                       const Vector3& shift_m) {
  const Matrix3 R = rotation.toRotationMatrix();
  std::vector<TruthSample> samples = truth.samples();
  for (TruthSample& sample : samples) {
    sample.position_enu_m = R * (sample.position_enu_m - pivot_m) + pivot_m + shift_m;
    sample.covariance_enu_m2 = R * sample.covariance_enu_m2 * R.transpose();
    if (sample.q_flu_to_enu) {
      sample.q_flu_to_enu = rotation * *sample.q_flu_to_enu;
    }
  }
  return TruthTrack(std::move(samples), truth.maxGap());
}

/// Stamp at which the estimate has covered `distance_m`, or its last one.
Nanoseconds stampAfter(const EstimateTrack& estimates, double distance_m) {
  double driven_m = 0.0;
  for (std::size_t i = 1; i < estimates.size(); ++i) {
    driven_m += (estimates[i].position_enu_m - estimates[i - 1].position_enu_m).head<2>().norm();
    if (driven_m >= distance_m) {
      return estimates[i].stamp;
    }
  }
  return estimates.back().stamp;
}

/// Horizontal positions of truth and of the estimate at the epochs of truth.
struct HorizontalPairs {
  std::vector<Vector2> truth;
  std::vector<Vector2> estimate;
};

HorizontalPairs pairsUntil(const TruthTrack& truth, const EstimateTrack& estimates, Nanoseconds last) {
  HorizontalPairs pairs;
  for (const TruthSample& sample : truth.samples()) {
    const auto estimate = interpolate(estimates, sample.stamp, truth.maxGap());
    if (estimate && sample.stamp <= last) {
      pairs.truth.push_back(sample.position_enu_m.head<2>());
      pairs.estimate.push_back(estimate->position_enu_m.head<2>());
    }
  }
  return pairs;
}

Vector2 centroid(const std::vector<Vector2>& points) {
  Vector2 sum = Vector2::Zero();
  for (const Vector2& point : points) {
    sum += point;
  }
  return sum / static_cast<double>(points.size());
}

}  // namespace

TruthTrack alignAtStart(const TruthTrack& truth, const EstimateTrack& estimates, StartAlignment alignment) {
  for (const TruthSample& start : truth.samples()) {
    const auto estimate = interpolate(estimates, start.stamp, truth.maxGap());
    if (!estimate) {
      continue;
    }
    if (!start.q_flu_to_enu) {
      throw std::invalid_argument("truth: no attitude at the start to align by");
    }
    const Quaternion rotation = alignment == StartAlignment::kFullPose
                                    ? estimate->q_flu_to_enu * start.q_flu_to_enu->conjugate()
                                    : rotationAboutUp(yaw(estimate->q_flu_to_enu) - yaw(*start.q_flu_to_enu));
    return moveRigidly(truth, rotation, start.position_enu_m, estimate->position_enu_m - start.position_enu_m);
  }
  throw std::invalid_argument("truth: no epoch in common with the estimate to align at");
}

double headingOffset(const TruthTrack& truth, const EstimateTrack& estimates, double distance_m) {
  if (estimates.empty()) {
    throw std::invalid_argument("truth: no estimate to align with");
  }
  const HorizontalPairs pairs = pairsUntil(truth, estimates, stampAfter(estimates, distance_m));
  if (pairs.truth.empty()) {
    throw std::invalid_argument("truth: no epoch in common with the estimate to align over");
  }
  const Vector2 truth_mean = centroid(pairs.truth);
  const Vector2 estimate_mean = centroid(pairs.estimate);
  double cosine = 0.0;
  double sine = 0.0;
  double extent_m = 0.0;
  for (std::size_t i = 0; i < pairs.truth.size(); ++i) {
    const Vector2 a = pairs.truth[i] - truth_mean;
    const Vector2 b = pairs.estimate[i] - estimate_mean;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
    extent_m = std::max(extent_m, (pairs.truth[i] - pairs.truth.front()).norm());
  }
  if (extent_m < kMinExtentM) {
    throw std::invalid_argument("truth: too little motion to align the heading by");
  }
  return std::atan2(sine, cosine);
}

TruthTrack alignHeading(const TruthTrack& truth, const EstimateTrack& estimates, double distance_m) {
  const Quaternion rotation = rotationAboutUp(headingOffset(truth, estimates, distance_m));
  return moveRigidly(truth, rotation, estimates.front().position_enu_m, Vector3::Zero());
}

TruthTrack removeLeverArm(const TruthTrack& truth, const EstimateTrack& estimates, const Vector3& lever_flu_m) {
  std::vector<TruthSample> samples;
  samples.reserve(truth.samples().size());
  for (TruthSample sample : truth.samples()) {
    const auto estimate = interpolate(estimates, sample.stamp, truth.maxGap());
    if (estimate) {
      sample.position_enu_m -= estimate->q_flu_to_enu * lever_flu_m;
      samples.push_back(sample);
    }
  }
  return TruthTrack(std::move(samples), truth.maxGap());
}

}  // namespace slipnav
