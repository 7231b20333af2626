#include "slipnav/core/ekf/engine/mean_motion.h"

#include <gtest/gtest.h>

namespace slipnav::test {
namespace {

constexpr double kStep_s = 0.02;
constexpr int kSteps = 5;

InsStep stepOf(int index) {
  InsStep step;
  step.start = fromSeconds(kStep_s * index);
  step.state.stamp = fromSeconds(kStep_s * (index + 1));
  return step;
}

VelocityJacobian seesVelocity() {
  VelocityJacobian H = VelocityJacobian::Zero();
  H.block<3, 3>(0, kVelocity).setIdentity();
  return H;
}

/// An error that starts as `error` and grows as a tilt under gravity does, added step by step.
class Drive {
 public:
  Drive() {
    transition_.nav.setZero();
    transition_.nav.leftCols<9>().setIdentity();
    transition_.nav(kVelocity, kAttitude + 1) = -9.8 * kStep_s;
    mean_.restart(fromSeconds(0.0) + 1);
  }

  void step(int index, const ErrorVector& error_at_start) {
    error_ = error_at_start;
    error_.head<9>() = transition_.nav.leftCols<9>() * error_at_start.head<9>();
    mean_.propagate(transition_);
    mean_.add(stepOf(index), error_.segment<3>(kVelocity), seesVelocity(), 1, fromSeconds(10.0));
  }

  MeanMotion& mean() { return mean_; }
  const ErrorVector& error() const { return error_; }

 private:
  ErrorTransition transition_;
  MeanMotion mean_;
  ErrorVector error_ = ErrorVector::Zero();
};

/// @return the error after a while of driving with a wrong tilt
ErrorVector tilted(Drive& drive) {
  ErrorVector error = ErrorVector::Zero();
  error(kAttitude + 1) = 0.05;
  error(kVelocity) = 0.1;
  for (int i = 0; i < kSteps; ++i) {
    drive.step(i, error);
    error = drive.error();
  }
  return error;
}

TEST(MeanMotion, AMeanDependsOnTheErrorAsItWasMeanwhile) {
  Drive drive;
  const ErrorVector error = tilted(drive);
  // The truth stands still: the mean of the estimated velocity is that of its error.
  const Vector3 expected = drive.mean().jacobian() * error;
  EXPECT_NEAR(drive.mean().mean()->v_eb_b.x(), expected.x(), 1e-6);
  EXPECT_GT(std::abs(error(kVelocity) - expected.x()), 0.01) << "the error now would have done as well";
}

TEST(MeanMotion, ACorrectionReachesBack) {
  Drive drive;
  const ErrorVector error = tilted(drive);
  drive.mean().correct(error, ErrorReset());  // all of it is known and taken out
  EXPECT_LT(drive.mean().mean()->v_eb_b.norm(), 1e-6);
}

TEST(MeanMotion, AResetIsUndoneInWhatTheMeanDependsOn) {
  Drive drive;
  drive.step(0, ErrorVector::Zero());
  const VelocityJacobian before = drive.mean().jacobian();
  ErrorReset reset;
  reset.nav.block<3, 3>(kVelocity, kAttitude).setConstant(0.3);
  reset.accel_bias = Eigen::AngleAxisd(0.4, Vector3::UnitY()).toRotationMatrix();
  drive.mean().correct(ErrorVector::Zero(), reset);
  const VelocityJacobian after = drive.mean().jacobian();
  EXPECT_LT((after.leftCols<9>() * reset.nav - before.leftCols<9>()).norm(), 1e-12);
  EXPECT_LT((after.middleCols<3>(kAccelBias) * reset.accel_bias - before.middleCols<3>(kAccelBias)).norm(), 1e-12);
  EXPECT_GT((drive.mean().jacobian() - before).norm(), 0.1);
}

TEST(MeanMotion, RestartForgets) {
  Drive drive;
  drive.step(0, ErrorVector::Ones());
  drive.mean().restart(fromSeconds(kStep_s));
  EXPECT_FALSE(drive.mean().mean());
}

}  // namespace
}  // namespace slipnav::test
