/// F and Φ against the strapdown mechanization itself: how the difference of two neighboring trajectories grows.

#include "slipnav/core/ekf/error_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "random_states.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav::test {
namespace {

const Vector3 kNoChange = Vector3::Zero();

using NavMatrix = Eigen::Matrix<double, 9, kNavStates>;

/// A nominal state with what drives it.
struct Situation {
  std::string name;
  NavigationState start;
  Vector3 f_ib_b;
  Vector3 omega_ib_b;
};

Situation levelAtRest() {
  NavigationState state;
  state.position = {degToRad(40.0), 0.2, 100.0};
  return {"level at rest", state, {0.0, 0.0, -9.8}, Vector3::Zero()};
}

Situation randomSituation(sim::RandomStream& random, double speed_mps) {
  NavigationState state = randomState(random, speed_mps);
  const Vector3 f_b = state.q_b_to_n.conjugate() * Vector3(0.0, 0.0, -9.8) + 3.0 * random.normal3();
  return {"at about " + std::to_string(speed_mps) + " m/s", state, f_b, 0.3 * random.normal3()};
}

std::vector<Situation> situations() {
  sim::RandomStream random(1, "situations");
  std::vector<Situation> all = {levelAtRest()};
  for (const double speed_mps : {0.01, 1.0, 1.0, 100.0, 4000.0, 4000.0, 4000.0}) {
    all.push_back(randomSituation(random, speed_mps));
  }
  return all;
}

ErrorDynamics dynamics() { return {Planet::byName("earth"), ImuNoiseParams{}, VehicleModelParams{}}; }

NavigationState mechanized(const Situation& s, const NavigationState& start, double duration_s) {
  const Strapdown strapdown(Planet::byName("earth"));
  const ImuInterval imu{s.f_ib_b + s.start.accel_bias_b, s.omega_ib_b + s.start.gyro_bias_b, duration_s};
  return strapdown.propagate(start, {}, imu, 0);
}

/// Change of each error over the interval, per unit of initial error; central differences.
NavMatrix growth(const Situation& s, double duration_s) {
  const Planet earth = Planet::byName("earth");
  ErrorVector size = ErrorVector::Constant(1e-3);
  size.segment<3>(kVelocity).setConstant(1.0);
  size.segment<3>(kPosition).setConstant(1000.0);
  NavMatrix result;
  for (int k = 0; k < kNavStates; ++k) {
    const auto changeFrom = [&](double sign) -> ErrorVector {
      NavigationState neighbor = s.start;
      subtractError(earth, unitError(k, -sign * size(k)), neighbor);
      const ErrorVector before = errorBetween(earth, neighbor, s.start);
      return errorBetween(earth, mechanized(s, neighbor, duration_s), mechanized(s, s.start, duration_s)) - before;
    };
    result.col(k) = (changeFrom(1.0) - changeFrom(-1.0)).head<9>() / (2.0 * size(k));
  }
  return result;
}

/// Rate of growth at the start: differences over T and T/2, extrapolated to zero.
NavMatrix numericSystemMatrix(const Situation& s) {
  const double T = 0.02;
  return 2.0 * growth(s, 0.5 * T) / (0.5 * T) - growth(s, T) / T;
}

/// Asserts that the block is right, and that one of zeros, or of the other sign, would not have passed.
void expectBlock(const NavMatrix& F, const NavMatrix& numeric, int row, int column, double tolerance,
                 const std::string& what) {
  const Matrix3 expected = numeric.block<3, 3>(row, column);
  const double error = (F.block<3, 3>(row, column) - expected).cwiseAbs().maxCoeff();
  EXPECT_LT(error, tolerance) << what << "\n" << F.block<3, 3>(row, column) << "\nnumerically\n" << expected;
}

struct Block {
  const char* name;
  int row;
  int column;
  double absolute;  ///< deliberately neglected by the linearization, and rounding
  double smallest;  ///< magnitude that the block has to reach in the fast situations, else the test says nothing
};

constexpr Block kBlocks[] = {
    {"attitude by attitude", kAttitude, kAttitude, 1e-9, 1e-4},
    {"attitude by velocity", kAttitude, kVelocity, 1e-12, 1e-7},
    {"attitude by position", kAttitude, kPosition, 1e-14, 1e-11},
    {"attitude by accelerometer bias", kAttitude, kAccelBias, 1e-9, 0.0},
    {"attitude by gyro bias", kAttitude, kGyroBias, 1e-5, 0.3},
    {"velocity by attitude", kVelocity, kAttitude, 1e-4, 3.0},
    {"velocity by velocity", kVelocity, kVelocity, 1e-8, 1e-4},
    {"velocity by position", kVelocity, kPosition, 2e-8, 1e-6},
    {"velocity by accelerometer bias", kVelocity, kAccelBias, 1e-5, 0.3},
    {"velocity by gyro bias", kVelocity, kGyroBias, 1e-3, 0.0},
    {"position by attitude", kPosition, kAttitude, 1e-3, 0.0},
    {"position by velocity", kPosition, kVelocity, 1e-6, 0.5},
    {"position by position", kPosition, kPosition, 1e-8, 1e-4},
    {"position by accelerometer bias", kPosition, kAccelBias, 1e-3, 0.0},
    {"position by gyro bias", kPosition, kGyroBias, 1e-3, 0.0},
};

TEST(ErrorDynamics, EveryBlockOfFAgreesWithTheMechanization) {
  const ErrorDynamics model = dynamics();
  for (const Situation& s : situations()) {
    const NavMatrix F = model.systemMatrix(s.start, s.f_ib_b);
    const NavMatrix numeric = numericSystemMatrix(s);
    for (const Block& block : kBlocks) {
      const double largest = numeric.block<3, 3>(block.row, block.column).cwiseAbs().maxCoeff();
      const double tolerance = block.absolute + 0.01 * largest;
      expectBlock(F, numeric, block.row, block.column, tolerance, s.name + ": " + block.name);
      if (s.start.v_eb_n.norm() > 1000.0 && block.smallest > 0.0) {
        EXPECT_GT(largest, block.smallest) << block.name;
        EXPECT_GT(largest, 10.0 * tolerance) << block.name;  // zeros would fail
      }
    }
  }
}

/// Φ of half a second against the mechanization over half a second: the blocks that first order leaves empty are right.
TEST(ErrorDynamics, TransitionIsOfSecondOrder) {
  const ErrorDynamics model = dynamics();
  sim::RandomStream random(7, "transition");
  for (int i = 0; i < 5; ++i) {
    const Situation s = randomSituation(random, 1.0);
    const auto largestError = [&](double T) {
      const ErrorTransition t =
          model.transition(s.start, mechanized(s, s.start, T), s.f_ib_b, s.omega_ib_b, kNoChange, T);
      NavMatrix change = t.nav;
      change.leftCols<9>() -= Eigen::Matrix<double, 9, 9>::Identity();
      return (change - growth(s, T)).cwiseAbs().maxCoeff();
    };
    EXPECT_GT(std::log2(largestError(0.5) / largestError(0.25)), 2.7);
    const double T = 0.02;
    const ErrorTransition t =
        model.transition(s.start, mechanized(s, s.start, T), s.f_ib_b, s.omega_ib_b, kNoChange, T);
    const NavMatrix numeric = growth(s, T);
    for (const auto& [row, column] :
         {std::pair(kPosition, kAttitude), std::pair(kVelocity, kGyroBias), std::pair(kPosition, kAccelBias)}) {
      const double largest = numeric.block<3, 3>(row, column).cwiseAbs().maxCoeff();
      EXPECT_GT(largest, 1e-4);
      EXPECT_LT((t.nav.block<3, 3>(row, column) - numeric.block<3, 3>(row, column)).cwiseAbs().maxCoeff(),
                0.02 * largest);
    }
  }
}

/// P ← Φ (P + ½Q) Φᵀ + ½Q with the whole matrix Φ.
TEST(ErrorDynamics, PropagationIsThatOfTheWholeMatrices) {
  sim::RandomStream random(9, "transition");
  for (int i = 0; i < 20; ++i) {
    const Situation s = randomSituation(random, 1.0);
    const double T = 0.5;
    const ErrorTransition t =
        dynamics().transition(s.start, mechanized(s, s.start, T), s.f_ib_b, s.omega_ib_b, kNoChange, T);
    ErrorCovariance P = randomCovariance(random);
    const ErrorCovariance half_noise = (0.5 * t.noise).asDiagonal();
    const ErrorCovariance expected = t.matrix() * (P + half_noise) * t.matrix().transpose() + half_noise;
    EXPECT_LT((t.times(P) - t.matrix() * P).norm(), 1e-12 * (t.matrix() * P).norm());
    ErrorDynamics::propagate(t, P);
    const ErrorVector sigma = expected.diagonal().cwiseSqrt();
    EXPECT_LT(((P - expected).array() / (sigma * sigma.transpose()).array()).abs().maxCoeff(), 1e-12);
    EXPECT_EQ(P, P.transpose());
  }
}

/// An estimate that takes the scale factor for larger than it is takes too much of the rate away.
TEST(ErrorDynamics, YawScaleTurnsTheAttitude) {
  const Planet earth = Planet::byName("earth");
  sim::RandomStream random(8, "transition");
  for (int i = 0; i < 5; ++i) {
    const Situation s = randomSituation(random, 1.0);
    const double T = 0.02;
    const double scale = 1e-3;
    Situation scaled = s;
    scaled.omega_ib_b.z() *= 1.0 - scale;
    const ErrorVector numeric = errorBetween(earth, mechanized(scaled, s.start, T), mechanized(s, s.start, T)) / scale;
    const ErrorTransition t =
        dynamics().transition(s.start, mechanized(s, s.start, T), s.f_ib_b, s.omega_ib_b, kNoChange, T);
    EXPECT_GT(t.attitude_from_yaw_scale.norm(), 1e-4);
    EXPECT_LT((t.attitude_from_yaw_scale - numeric.segment<3>(kAttitude)).norm(),
              0.02 * t.attitude_from_yaw_scale.norm());
    EXPECT_LT((t.velocity_from_yaw_scale - numeric.segment<3>(kVelocity)).norm(),
              0.05 * t.velocity_from_yaw_scale.norm());
  }
}

/// A step whose mean rate differs from that of the step before.
class FasterTurn {
 public:
  FasterTurn(const Situation& s, const Vector3& change_b)
      : s_(s),
        change_b_(change_b),
        before_{s.f_ib_b, s.omega_ib_b - change_b + s.start.gyro_bias_b, kStep_s},
        now_{s.f_ib_b + s.start.accel_bias_b, s.omega_ib_b + s.start.gyro_bias_b, kStep_s} {}

  NavigationState from(const NavigationState& start) const {
    return Strapdown(Planet::byName("earth")).propagate(start, before_, now_, 0);
  }
  ErrorTransition transition() const {
    return dynamics().transition(s_.start, from(s_.start), s_.f_ib_b, s_.omega_ib_b, change_b_, kStep_s);
  }

 private:
  static constexpr double kStep_s = 0.02;
  Situation s_;
  Vector3 change_b_;
  ImuInterval before_;
  ImuInterval now_;
};

/// An estimate that takes the IMU to be farther ahead than it is removes too much of what turning makes it feel.
TEST(ErrorDynamics, ImuOffsetMovesTheVelocity) {
  const Planet earth = Planet::byName("earth");
  sim::RandomStream random(10, "transition");
  for (int i = 0; i < 5; ++i) {
    const Situation s = randomSituation(random, 1.0);
    const FasterTurn turn(s, 0.2 * random.normal3());
    const NavigationState end = turn.from(s.start);
    const ErrorTransition t = turn.transition();
    for (int axis = 0; axis < 2; ++axis) {
      NavigationState shifted = s.start;
      shifted.imu_offset_b(axis) += 0.1;
      const ErrorVector numeric = 10.0 * errorBetween(earth, turn.from(shifted), end);
      const Eigen::Matrix<double, 6, 1> column = t.motion_from_offset.col(axis);
      EXPECT_GT(column.head<3>().norm(), 0.01);
      EXPECT_LT((column.head<3>() - numeric.segment<3>(kVelocity)).norm(), 0.02 * column.head<3>().norm());
      EXPECT_LT((column.tail<3>() - numeric.segment<3>(kPosition)).norm(), 0.02 * column.tail<3>().norm());
    }
  }
}

/// Turned about the vertical with everything that moves, the world looks the same to IMU and wheels: Φ leads from
/// turned to turned velocity, however far the IMU is from where it is configured to be.
TEST(ErrorDynamics, HeadingStaysUnobservableWithAnOffset) {
  sim::RandomStream random(11, "transition");
  for (int i = 0; i < 5; ++i) {
    Situation s = randomSituation(random, 1.0);
    s.start.imu_offset_b = Vector3(0.4, -0.3, 0.0);
    const FasterTurn turn(s, 0.2 * random.normal3());
    const NavigationState end = turn.from(s.start);
    const ErrorTransition t = turn.transition();
    const Vector3 turned_before = Vector3::UnitZ().cross(s.start.v_eb_n);
    const Vector3 turned =
        t.nav.block<3, 1>(kVelocity, kAttitude + 2) + t.nav.block<3, 3>(kVelocity, kVelocity) * turned_before;
    EXPECT_GT((turned - turned_before).norm(), 0.02);
    EXPECT_LT((turned - Vector3::UnitZ().cross(end.v_eb_n)).norm(), 1e-3);
  }
}

}  // namespace
}  // namespace slipnav::test
