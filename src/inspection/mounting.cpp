#include "inspection/mounting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <stdexcept>

#include "calibration/batch_regression.h"
#include "core/base/square.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

using Complex = std::complex<double>;

constexpr double kLeastBatches = 5.0;
/// A direction known less well than this counts as not found.
constexpr double kLargestStd_rad = 0.35;
constexpr double kHalfQuarter_rad = 0.25 * kPi;
/// A batch is clear if force and wheels correlate by more.
constexpr double kClear = 0.6;
/// Tilt and slip correlate with the wheels by chance, of some twenty pieces a few by 0.6 to 0.8; starts, brakes and
/// bends by 0.9 or more.
constexpr double kCertain = 0.9;
constexpr double kSigmas = 3.0;
/// Sine of a pitch of 90° less this.
constexpr double kUpright = 1e-9;

/// Axes across `up`: their product is up.
struct Plane {
  explicit Plane(const Vector3& up) {
    const Vector3 other = std::abs(up.x()) < 0.7 ? Vector3::UnitX() : Vector3::UnitY();
    first = (other - up * up.dot(other)).normalized();
    second = up.cross(first);
  }
  Complex of(const Vector3& v) const { return {first.dot(v), second.dot(v)}; }
  Vector3 toVector(Complex c) const { return first * c.real() + second * c.imag(); }
  Vector3 first;
  Vector3 second;
};

/// Sums of a complex regression of force on motion through the origin, over one batch.
struct BatchSums {
  Complex product = 0.0;  ///< Σ force · conj(motion)
  double motion = 0.0;    ///< Σ |motion|²
  double force = 0.0;     ///< Σ |force|²
};

struct Gain {
  Complex value = 0.0;
  double along_std = 0.0;
  double across_std = 0.0;
};

/// Force over motion with the scatter from batch to batch.
Gain gainOf(const std::vector<BatchSums>& batches) {
  BatchSums all;
  for (const BatchSums& batch : batches) {
    all.product += batch.product;
    all.motion += batch.motion;
  }
  Gain gain;
  if (all.motion <= 0.0 || std::abs(all.product) <= 0.0) {
    return gain;
  }
  gain.value = all.product / all.motion;
  const Complex direction = gain.value / std::abs(gain.value);
  double along = 0.0;
  double across = 0.0;
  for (const BatchSums& batch : batches) {
    const Complex score = (batch.product - gain.value * batch.motion) * std::conj(direction);
    along += square(score.real());
    across += square(score.imag());
  }
  const auto count = static_cast<double>(batches.size());
  const double correction = std::sqrt(count / std::max(count - 1.0, 1.0)) / all.motion;
  gain.along_std = correction * std::sqrt(along);
  gain.across_std = correction * std::sqrt(across);
  return gain;
}

/// Motion of each row in the plane: acceleration forward, speed times heading rate to the left; without mean.
std::vector<std::vector<Complex>> motionByBatch(const std::vector<std::vector<MotionRow>>& batches, const Vector3& up) {
  std::vector<std::vector<Complex>> motions;
  for (const std::vector<MotionRow>& rows : batches) {
    double mean = 0.0;
    for (const MotionRow& row : rows) {
      mean += row.speed * up.dot(row.rate) / static_cast<double>(rows.size());
    }
    motions.emplace_back();
    for (const MotionRow& row : rows) {
      motions.back().emplace_back(row.acceleration, row.speed * up.dot(row.rate) - mean);
    }
  }
  return motions;
}

std::vector<std::vector<MotionRow>> byBatch(const MotionTable& table) {
  std::vector<std::vector<MotionRow>> batches;
  for (const MotionRow& row : table.rows) {
    if (batches.empty() || batches.back().front().batch != row.batch) {
      batches.emplace_back();
    }
    batches.back().push_back(row);
  }
  return batches;
}

void estimateForward(const std::vector<std::vector<MotionRow>>& batches, Mounting& mounting) {
  const Plane plane(mounting.up);
  const std::vector<std::vector<Complex>> motions = motionByBatch(batches, mounting.up);
  std::vector<BatchSums> sums(batches.size());
  for (std::size_t b = 0; b < batches.size(); ++b) {
    for (std::size_t i = 0; i < batches[b].size(); ++i) {
      const Complex force = plane.of(batches[b][i].force);
      sums[b].product += force * std::conj(motions[b][i]);
      sums[b].motion += std::norm(motions[b][i]);
      sums[b].force += std::norm(force);
    }
  }
  const Gain gain = gainOf(sums);
  mounting.force_gain = std::abs(gain.value);
  if (mounting.force_gain <= 0.0) {
    return;
  }
  const Complex direction = gain.value / mounting.force_gain;
  mounting.force_gain_std = gain.along_std;
  mounting.forward_std_rad = std::atan(gain.across_std / mounting.force_gain);
  mounting.forward = plane.toVector(direction);
  BatchSums all;
  for (const BatchSums& batch : sums) {
    const double likeness =
        (batch.product * std::conj(direction)).real() / std::sqrt(batch.motion * batch.force + 1e-12);
    mounting.batches_forward += likeness > kClear ? 1 : 0;
    mounting.batches_backward += likeness < -kClear ? 1 : 0;
    mounting.batches_certainly_forward += likeness > kCertain ? 1 : 0;
    mounting.batches_certainly_backward += likeness < -kCertain ? 1 : 0;
    all.motion += batch.motion;
    all.force += batch.force;
  }
  mounting.force_correlation = mounting.force_gain * std::sqrt(all.motion / std::max(all.force, 1e-12));
  const auto agree = static_cast<double>(mounting.batches_forward);
  const auto contradict = static_cast<double>(mounting.batches_backward);
  const bool has_sign = mounting.force_gain > kSigmas * mounting.force_gain_std ||
                        agree - contradict >= kSigmas * std::sqrt(agree + contradict + 1.0);  // a sign test
  mounting.has_forward =
      static_cast<double>(batches.size()) >= kLeastBatches && mounting.forward_std_rad < kLargestStd_rad && has_sign;
}

/// Lateral force against speed times heading rate only.
void estimateCentripetal(const std::vector<std::vector<MotionRow>>& batches, Mounting& mounting) {
  const Vector3 left = mounting.up.cross(mounting.forward);
  const std::vector<std::vector<Complex>> motions = motionByBatch(batches, mounting.up);
  std::vector<BatchSums> sums(batches.size());
  for (std::size_t b = 0; b < batches.size(); ++b) {
    for (std::size_t i = 0; i < batches[b].size(); ++i) {
      sums[b].product += left.dot(batches[b][i].force) * motions[b][i].imag();
      sums[b].motion += square(motions[b][i].imag());
    }
  }
  const Gain gain = gainOf(sums);
  mounting.centripetal_ratio = gain.value.real() / mounting.force_gain;
  mounting.centripetal_std = gain.along_std / mounting.force_gain;
}

/// The wheels' turn over the gyros' by robust regression: slip comes in impulses.
void regressTurn(const MotionTable& table, Mounting& mounting) {
  RegressionProblem problem(1);
  for (const MotionRow& row : table.rows) {
    problem.add(Eigen::VectorXd::Constant(1, mounting.up.dot(row.rate)), row.turn, row.batch);
  }
  try {
    const RegressionResult result = regress(problem);
    mounting.turn_per_rate = result.estimate(0);
    mounting.turn_per_rate_std = std::sqrt(std::max(result.covariance(0, 0), 0.0));
    mounting.has_turn = std::abs(mounting.turn_per_rate) > kSigmas * mounting.turn_per_rate_std;
  } catch (const std::invalid_argument&) {
    mounting.has_turn = false;  // the vehicle does not turn
  }
}

void estimateTurn(const MotionTable& table, Mounting& mounting) {
  Vector3 axis = Vector3::Zero();
  double product = 0.0;
  double turned = 0.0;
  double rotated = 0.0;
  for (const MotionRow& row : table.rows) {
    const double rate = mounting.up.dot(row.rate);
    product += rate * row.turn;
    rotated += square(rate);
    turned += square(row.turn);
    axis += row.rate * row.turn;
  }
  if (turned <= 0.0 || rotated <= 0.0) {
    return;
  }
  mounting.turn_axis = axis.norm() > 0.0 ? axis.normalized() : mounting.up;
  mounting.turn_correlation = product / std::sqrt(rotated * turned);
  regressTurn(table, mounting);
}

double angleBetween(const Matrix3& a, const Matrix3& b) {
  return rotationVectorFromQuaternion(Quaternion(Matrix3(a * b.transpose()))).norm();
}

void chooseNearest(Mounting& mounting) {
  if (mounting.has_forward) {
    Matrix3 estimate;
    estimate.row(0) = mounting.forward;
    estimate.row(1) = mounting.up.cross(mounting.forward);
    estimate.row(2) = mounting.up;
    const std::vector<Matrix3> turns = quarterTurns();
    mounting.nearest = *std::min_element(turns.begin(), turns.end(), [&estimate](const Matrix3& a, const Matrix3& b) {
      return angleBetween(estimate, a) < angleBetween(estimate, b);
    });
    mounting.left_over_rad = angleBetween(estimate, mounting.nearest);
    mounting.is_sure = mounting.left_over_rad + kSigmas * mounting.forward_std_rad < kHalfQuarter_rad;
  }
}

}  // namespace

Mounting estimateMounting(const MotionTable& table, const RestPicture& rest) {
  Mounting mounting;
  if (rest.force.norm() > 0.0) {
    mounting.up = rest.force.normalized();
  }
  const std::vector<std::vector<MotionRow>> batches = byBatch(table);
  estimateForward(batches, mounting);
  if (mounting.has_forward) {
    estimateCentripetal(batches, mounting);
  }
  estimateTurn(table, mounting);
  chooseNearest(mounting);
  return mounting;
}

std::vector<Matrix3> quarterTurns() {
  const std::array<Vector3, 6> axes = {Vector3::UnitX(),  Vector3::UnitY(),  Vector3::UnitZ(),
                                       -Vector3::UnitX(), -Vector3::UnitY(), -Vector3::UnitZ()};
  std::vector<Matrix3> turns;
  for (const Vector3& forward : axes) {
    for (const Vector3& up : axes) {
      if (std::abs(forward.dot(up)) < 0.5) {
        Matrix3 turn;
        turn.row(0) = forward;
        turn.row(1) = up.cross(forward);
        turn.row(2) = up;
        turns.push_back(turn);
      }
    }
  }
  return turns;
}

MountParams toMountParams(const Matrix3& C_sensor_to_flu) {
  Vector3 angles_rad = eulerFrom_q_b_to_n(Quaternion(C_sensor_to_flu));
  if (std::abs(C_sensor_to_flu(2, 0)) > 1.0 - kUpright) {  // roll and yaw turn about the same axis then
    angles_rad.x() = 0.0;
    angles_rad.z() = std::atan2(-C_sensor_to_flu(0, 1), C_sensor_to_flu(1, 1));
  }
  MountParams params;
  params.roll_deg = radToDeg(angles_rad.x());
  params.pitch_deg = radToDeg(angles_rad.y());
  params.yaw_deg = radToDeg(angles_rad.z());
  return params;
}

Matrix3 toRotation(const MountParams& mount) {
  return q_b_to_n_fromEuler(degToRad(mount.roll_deg), degToRad(mount.pitch_deg), degToRad(mount.yaw_deg))
      .toRotationMatrix();
}

std::string axesText(const Matrix3& C_sensor_to_flu) {
  const std::array<std::array<const char*, 2>, 3> names = {{{"forward", "back"}, {"left", "right"}, {"up", "down"}}};
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Index along = 0;
    C_sensor_to_flu.col(axis).cwiseAbs().maxCoeff(&along);
    const bool negative = C_sensor_to_flu(along, axis) < 0.0;
    text += (axis == 0 ? "" : ", ") + std::string(1, "xyz"[axis]) + " " +
            names[static_cast<std::size_t>(along)][negative ? 1 : 0];
  }
  return text;
}

}  // namespace slipnav
