#pragma once
/// Replays recordings through the nodelets that the launch file has started, and compares with the offline run.

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <memory>
#include <string>

#include "ros/bag/bag_evaluation.h"
#include "ros/replay/replay_session.h"
#include "ros/runtime/parameters.h"
#include "ros/simulated_bag.h"

namespace slipnav::test {

/// The nodelets live through all tests: each recording begins with a clock that goes back.
class ReplayFixture : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    config_ = std::make_unique<Config>(configFromParameters(ros::NodeHandle(), "slipnav"));
    session_ = std::make_unique<ReplaySession>(config_->topics);
    session_->waitForNodelets();
    bag_ = std::make_unique<TemporaryBag>();
    writeShortDrive(bag_->path(), *config_);
  }

  static void TearDownTestSuite() {
    session_.reset();
    bag_.reset();
  }

  static void expectEqual(const EstimateTrack& replayed, const EstimateTrack& offline) {
    ASSERT_GT(offline.size(), 500U);
    ASSERT_EQ(replayed.size(), offline.size());
    for (std::size_t i = 0; i < offline.size(); ++i) {
      ASSERT_EQ(replayed[i].stamp, offline[i].stamp);
      ASSERT_EQ(replayed[i].position_enu_m, offline[i].position_enu_m) << "at estimate " << i;
      ASSERT_EQ(replayed[i].q_flu_to_enu.coeffs(), offline[i].q_flu_to_enu.coeffs()) << "at estimate " << i;
      ASSERT_EQ(replayed[i].covariance_enu_m2, offline[i].covariance_enu_m2) << "at estimate " << i;
      ASSERT_EQ(replayed[i].speed_mps, offline[i].speed_mps) << "at estimate " << i;
      ASSERT_EQ(replayed[i].stationary, offline[i].stationary) << "at estimate " << i;
      ASSERT_EQ(replayed[i].slip, offline[i].slip) << "at estimate " << i;
    }
  }

  static BagEvaluation replayAndCompare(const std::string& path, double rate) {
    BagEvaluation offline = evaluateBag(path, *config_, "", {});
    session_->play({path, rate, 0.0, 0.0}, offline.report.estimates.back().stamp);
    expectEqual(session_->recorder().track(), offline.report.estimates);
    EXPECT_EQ(session_->odometry().bytes(), offline.odometry.bytes());
    return offline;
  }

  inline static std::unique_ptr<Config> config_;
  inline static std::unique_ptr<ReplaySession> session_;
  inline static std::unique_ptr<TemporaryBag> bag_;
};

}  // namespace slipnav::test
