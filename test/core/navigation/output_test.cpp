#include "slipnav/core/navigation/output.h"

#include <gtest/gtest.h>

#include "random_states.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav::test {
namespace {

const Planet& earth() {
  static const Planet planet = Planet::byName("earth");
  return planet;
}

/// Heads east at 0.8 m/s, 3 m north of the origin, turning left in the user's eyes.
Estimate eastbound(const Geodetic& origin) {
  Estimate estimate;
  estimate.nav.q_b_to_n = q_b_to_n_fromEuler(0.0, 0.0, 0.5 * kPi);
  estimate.nav.v_eb_n = Vector3(0.0, 0.8, 0.0);
  estimate.nav.position = origin;
  subtractError(earth(), unitError(kPosition, -3.0), estimate.nav);
  estimate.omega_ib_b =
      Vector3(0.0, 0.0, -0.2) + estimate.nav.q_b_to_n.conjugate() * earth().omega_ie_n(origin.latitude_rad);
  return estimate;
}

TEST(Output, IsInTheAxesOfRos) {
  const Geodetic origin{0.7, 0.1, 200.0};
  const OutputMaker maker(earth(), origin, Vector3::Zero(), 0.0);
  const Output out = maker.make(eastbound(origin), ErrorCovariance::Identity());
  EXPECT_NEAR((out.position_enu_m - Vector3(0.0, 3.0, 0.0)).norm(), 0.0, 1e-4);
  EXPECT_NEAR((out.q_flu_to_enu * Vector3::UnitX() - Vector3::UnitX()).norm(), 0.0, 1e-6);
  EXPECT_NEAR((out.q_flu_to_enu * Vector3::UnitZ() - Vector3::UnitZ()).norm(), 0.0, 1e-6);
  EXPECT_NEAR((out.velocity_flu_mps - Vector3(0.8, 0.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((out.angular_rate_flu_radps - Vector3(0.0, 0.0, 0.2)).norm(), 0.0, 1e-9);
}

TEST(Output, IsThatOfBaseLink) {
  const Geodetic origin{0.7, 0.1, 200.0};
  const Vector3 lever_b(-1.0, 0.5, 2.0);  // base_link lies behind, right of and below the IMU
  const Output out = OutputMaker(earth(), origin, lever_b, 0.0).make(eastbound(origin), ErrorCovariance::Identity());
  EXPECT_NEAR((out.position_enu_m - Vector3(-1.0, 2.5, -2.0)).norm(), 0.0, 1e-4);
  // ω × l with ω = −0.2 about down: (0.1, 0.2, 0) in body axes
  EXPECT_NEAR((out.velocity_flu_mps - Vector3(0.9, -0.2, 0.0)).norm(), 0.0, 1e-6);
}

/// Both covariances against central differences of the output itself.
TEST(Output, CovariancesFollowTheOutput) {
  sim::RandomStream random(1, "output");
  for (int i = 0; i < 10; ++i) {
    Estimate estimate;
    estimate.nav = randomState(random, 1.0);
    const Vector3 measured_rate = 0.3 * random.normal3();
    const OutputMaker maker(earth(), estimate.nav.position, random.normal3(), 0.0);
    const auto outputWith = [&](const ErrorVector& error) {
      Estimate off = estimate;
      subtractError(earth(), -error, off.nav);
      off.omega_ib_b = measured_rate - off.nav.gyro_bias_b;
      return maker.make(off, ErrorCovariance::Zero());
    };
    Eigen::Matrix<double, 12, kErrorStates> J;
    for (int k = 0; k < kErrorStates; ++k) {
      const double size = k >= kPosition && k < kPosition + 3 ? 1.0 : 1e-4;
      const Output plus = outputWith(unitError(k, size));
      const Output minus = outputWith(unitError(k, -size));
      J.col(k) << plus.position_enu_m - minus.position_enu_m,
          rotationVectorFromQuaternion(plus.q_flu_to_enu * minus.q_flu_to_enu.conjugate()),
          plus.velocity_flu_mps - minus.velocity_flu_mps, plus.angular_rate_flu_radps - minus.angular_rate_flu_radps;
      J.col(k) /= 2.0 * size;
    }
    const ErrorCovariance P = randomCovariance(random);
    const Output out = maker.make(estimate, P);
    const Covariance6 pose = J.topRows<6>() * P * J.topRows<6>().transpose();
    const Covariance6 twist = J.bottomRows<6>() * P * J.bottomRows<6>().transpose();
    EXPECT_LT((out.pose_covariance - pose).cwiseAbs().maxCoeff(), 1e-3 * pose.cwiseAbs().maxCoeff());
    EXPECT_LT((out.twist_covariance - twist).cwiseAbs().maxCoeff(), 1e-2 * twist.cwiseAbs().maxCoeff());
    EXPECT_GT((pose.bottomRightCorner<3, 3>().norm()), 1e-5);
    EXPECT_LT((out.pose_covariance - pose).bottomRows<3>().cwiseAbs().maxCoeff(),
              1e-3 * pose.bottomRows<3>().cwiseAbs().maxCoeff());
  }
}

/// Over the 50 Hz at which rates are published.
TEST(Output, NoiseOfTheGyrosIsThatOfThePublishedRate) {
  const Geodetic origin{0.7, 0.1, 200.0};
  Estimate estimate = eastbound(origin);
  estimate.nav.stamp = 7 * kSecond;
  const ErrorCovariance P = ErrorCovariance::Identity();
  const Output quiet = OutputMaker(earth(), origin, Vector3::Zero(), 0.0).make(estimate, P);
  const Output noisy = OutputMaker(earth(), origin, Vector3::Zero(), 1e-3).make(estimate, P);
  EXPECT_EQ(noisy.stamp, 7 * kSecond);
  Covariance6 expected = Covariance6::Zero();
  expected.diagonal().tail<3>().setConstant(0.05);
  EXPECT_LT((noisy.twist_covariance - quiet.twist_covariance - expected).norm(), 1e-12);
  EXPECT_EQ(noisy.pose_covariance, quiet.pose_covariance);
}

}  // namespace
}  // namespace slipnav::test
