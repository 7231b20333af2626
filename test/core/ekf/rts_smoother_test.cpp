#include "slipnav/core/ekf/rts_smoother.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <vector>

#include "random_states.h"
#include "slipnav/core/base/rotation.h"
#include "slipnav/core/ekf/kalman_update.h"

namespace slipnav::test {
namespace {

/// The states of the toy: position, velocity and the bias of an acceleration, along north. All others rest.
constexpr std::array<int, 3> kToy = {kPosition, kVelocity, kAccelBias};
constexpr int kToyStates = static_cast<int>(kToy.size());
constexpr double kStep_s = 0.5;

using ToyVector = Eigen::Matrix<double, kToyStates, 1>;
using ToyMatrix = Eigen::Matrix<double, kToyStates, kToyStates>;

template <class Matrix>
ToyMatrix toyPart(const Matrix& P) {
  return P(kToy, kToy);
}

ErrorCovariance transition() {
  ErrorCovariance phi = ErrorCovariance::Identity();
  phi(kPosition, kVelocity) = kStep_s;
  phi(kPosition, kAccelBias) = -0.5 * kStep_s * kStep_s;
  phi(kVelocity, kAccelBias) = -kStep_s;
  return phi;
}

ErrorVector noise() {
  ErrorVector variance = ErrorVector::Constant(1e-4);
  variance(kPosition) = 0.01;
  variance(kVelocity) = 0.04;
  variance(kAccelBias) = 0.0001;
  return variance;
}

/// What may happen at an epoch beside the step and the measurement.
struct Event {
  bool measured = false;
  bool forgets_velocity = false;
  bool kept = true;
};

constexpr double kForgottenVariance = 9.0;
constexpr double kMeasurementVariance = 0.25;

/// A linear filter in closed loop: its estimate is corrected, its error starts over at zero. The same drive as one
/// least squares problem over all epochs.
class Toy {
 public:
  explicit Toy(std::uint64_t seed) : random_(seed, "toy") {
    P_ = 4.0 * ErrorCovariance::Identity();
    smoother_.begin(P_);
    const int columns = kToyStates;
    information_ = Eigen::MatrixXd::Identity(columns, columns) / 4.0;
    vector_ = Eigen::VectorXd::Zero(columns);
  }

  /// @param turn_rad the axes in which the errors are counted turn with each correction, as those of the filter do
  void run(const std::vector<Event>& events, double turn_rad) {
    for (const Event& event : events) {
      step(event);
      if (event.measured) {
        measure(turn_rad);
      }
      if (event.kept) {
        smoother_.keep(P_);
        kept_.push_back({estimate_, axes_, epochs_});
      }
    }
  }

  /// The largest difference of estimate and covariance to those of least squares.
  double largestDifference() const {
    const Eigen::MatrixXd covariance = information_.inverse();
    const Eigen::VectorXd solution = covariance * vector_;
    const std::vector<SmoothedError> smoothed = smoother_.smooth();
    EXPECT_EQ(smoothed.size(), kept_.size());
    double largest = 0.0;
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      const ErrorCovariance back = kept_[i].axes.inverse();
      const ErrorVector state = kept_[i].estimate - back * smoothed[i].error;
      const ErrorCovariance P = back * smoothed[i].P * back.transpose();
      const int at = kToyStates * kept_[i].epoch;
      const ToyVector difference = state(kToy) - solution.segment<kToyStates>(at);
      const ToyMatrix spread = toyPart(P) - covariance.block<kToyStates, kToyStates>(at, at);
      largest = std::max({largest, difference.cwiseAbs().maxCoeff(), spread.cwiseAbs().maxCoeff()});
    }
    return largest;
  }

  const RtsSmoother& smoother() const { return smoother_; }
  const std::vector<ErrorCovariance>& filtered() const { return filtered_; }
  const ErrorCovariance& P() const { return P_; }

 private:
  struct Kept {
    ErrorVector estimate;
    ErrorCovariance axes;  ///< errors of the filter = axes · errors of the estimate
    int epoch;
  };

  void step(const Event& event) {
    ErrorCovariance phi = transition();
    ErrorVector variance = noise();
    estimate_ = phi * estimate_;
    const ErrorCovariance phi_of_errors = axes_ * phi * axes_.inverse();
    P_ = phi_of_errors * P_ * phi_of_errors.transpose();
    P_ += axes_ * variance.asDiagonal() * axes_.transpose();
    smoother_.propagate(phi_of_errors);
    if (event.forgets_velocity) {
      forgetError(kVelocity, kForgottenVariance, P_);
      smoother_.forget(kVelocity);
      estimate_(kVelocity) = 0.0;
      phi.row(kVelocity).setZero();
      variance(kVelocity) = kForgottenVariance;
    }
    addStepToLeastSquares(toyPart(phi), variance(kToy).cwiseInverse().asDiagonal());
  }

  void measure(double turn_rad) {
    ErrorVector h = ErrorVector::Zero();
    h(kPosition) = 1.0;
    const double measured = 3.0 * random_.normal();
    Measurement m(1);
    m.H = h.transpose() * axes_.inverse();
    m.residual(0) = measured - estimate_(kPosition);
    m.variance(0) = kMeasurementVariance;
    smoother_.advance(P_);
    const ErrorVector error = *kalmanUpdate(m, P_);
    estimate_ -= axes_.inverse() * error;
    ErrorReset reset;
    reset.nav.block<3, 3>(kVelocity, kVelocity) =
        quaternionFromRotationVector(Vector3(0.3, 0.1, 1.0) * turn_rad).toRotationMatrix();
    reset.nav.block<3, 3>(kVelocity, kPosition) = turn_rad * Matrix3::Identity();
    reset.accel_bias = quaternionFromRotationVector(Vector3(0.0, 0.5, -1.0) * turn_rad).toRotationMatrix();
    applyReset(reset, P_);
    ErrorCovariance turn = ErrorCovariance::Identity();
    turn.topLeftCorner<9, 9>() = reset.nav;
    turn.block<3, 3>(kAccelBias, kAccelBias) = reset.accel_bias;
    axes_ = (turn * axes_).eval();
    smoother_.correct(error, reset, P_);
    filtered_.push_back(P_);
    const int at = kToyStates * epochs_;
    information_(at, at) += 1.0 / kMeasurementVariance;
    vector_(at) += measured / kMeasurementVariance;
  }

  /// Adds an epoch x' with x' − phi x = noise.
  void addStepToLeastSquares(const ToyMatrix& phi, const ToyMatrix& weight) {
    const int at = kToyStates * epochs_;
    const int columns = at + 2 * kToyStates;
    Eigen::MatrixXd larger = Eigen::MatrixXd::Zero(columns, columns);
    larger.topLeftCorner(information_.rows(), information_.cols()) = information_;
    Eigen::MatrixXd row = Eigen::MatrixXd::Zero(kToyStates, columns);
    row.middleCols<kToyStates>(at) = -phi;
    row.middleCols<kToyStates>(at + kToyStates).setIdentity();
    information_ = larger + row.transpose() * weight * row;
    vector_.conservativeResizeLike(Eigen::VectorXd::Zero(columns));
    ++epochs_;
  }

  sim::RandomStream random_;
  RtsSmoother smoother_;
  ErrorVector estimate_ = ErrorVector::Zero();
  ErrorCovariance P_;
  ErrorCovariance axes_ = ErrorCovariance::Identity();
  std::vector<Kept> kept_;
  std::vector<ErrorCovariance> filtered_;
  Eigen::MatrixXd information_;
  Eigen::VectorXd vector_;
  int epochs_ = 0;
};

std::vector<Event> measuredEvery(int count, int every) {
  std::vector<Event> events(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    events[static_cast<std::size_t>(i)].measured = i % every == every - 1;
  }
  return events;
}

TEST(RtsSmoother, IsTheLeastSquaresSolutionOverAllEpochs) {
  Toy toy(1);
  toy.run(measuredEvery(40, 3), 0.0);
  EXPECT_LT(toy.largestDifference(), 1e-9);
}

TEST(RtsSmoother, EpochsThatAreNotKeptAreNotLost) {
  Toy toy(2);
  std::vector<Event> events = measuredEvery(60, 2);
  for (std::size_t i = 0; i + 1 < events.size(); ++i) {
    events[i].kept = i % 7 == 0;
  }
  toy.run(events, 0.0);
  EXPECT_EQ(toy.smoother().size(), 10U);
  EXPECT_LT(toy.largestDifference(), 1e-9);
}

TEST(RtsSmoother, ErrorsAreCountedInAxesThatTurnWithEachCorrection) {
  Toy toy(3);
  toy.run(measuredEvery(40, 3), 0.1);
  EXPECT_LT(toy.largestDifference(), 1e-9);
}

TEST(RtsSmoother, WhatWasForgottenTellsNothingOfThePast) {
  Toy toy(4);
  std::vector<Event> events = measuredEvery(40, 3);
  events[20].forgets_velocity = true;
  toy.run(events, 0.0);
  EXPECT_LT(toy.largestDifference(), 1e-9);
}

TEST(RtsSmoother, TheLastEpochIsTheFiltersOwn) {
  Toy toy(5);
  toy.run(measuredEvery(20, 4), 0.1);
  const SmoothedError last = toy.smoother().smooth().back();
  EXPECT_EQ(last.error, ErrorVector::Zero());
  EXPECT_EQ(last.P, toy.P());
}

TEST(RtsSmoother, NothingIsLessCertainThanBefore) {
  Toy toy(6);
  std::vector<Event> events(30, Event{true, false, true});
  toy.run(events, 0.1);
  const std::vector<SmoothedError> smoothed = toy.smoother().smooth();
  ASSERT_EQ(smoothed.size(), toy.filtered().size());
  double gained = 0.0;
  for (std::size_t i = 0; i < smoothed.size(); ++i) {
    const ErrorCovariance difference = toy.filtered()[i] - smoothed[i].P;
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<ErrorCovariance>(difference).eigenvalues().minCoeff(), -1e-12);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<ErrorCovariance>(smoothed[i].P).eigenvalues().minCoeff(), 0.0);
    gained = std::max(gained, difference(kPosition, kPosition) / toy.filtered()[i](kPosition, kPosition));
  }
  EXPECT_GT(gained, 0.3);
}

/// A state without variance, such as a wheel radius that counts as known.
TEST(RtsSmoother, WhatIsKnownExactlyStaysSo) {
  ErrorCovariance P = ErrorCovariance::Identity();
  P(kWheelScale, kWheelScale) = 0.0;
  RtsSmoother smoother;
  smoother.begin(P);
  smoother.keep(P);
  smoother.propagate(transition());
  P = transition() * P * transition().transpose();
  P(kPosition, kPosition) += 1.0;
  smoother.keep(P);
  const SmoothedError first = smoother.smooth().front();
  EXPECT_TRUE(first.P.allFinite());
  EXPECT_EQ(first.P(kWheelScale, kWheelScale), 0.0);
  EXPECT_NEAR(first.P(kPosition, kPosition), 1.0, 1e-12);
}

}  // namespace
}  // namespace slipnav::test
