#include "evaluation/tum.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "slipnav/core/base/rotation.h"

namespace slipnav {
namespace {

class Tum : public ::testing::Test {
 protected:
  void TearDown() override { std::remove(path_.c_str()); }

  void write(const std::string& text) const { std::ofstream(path_) << text; }

  std::string errorOf(const std::string& text) const {
    write(text);
    try {
      readTum(path_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  const std::string path_ = ::testing::TempDir() + "slipnav_tum_test.tum";
};

TEST_F(Tum, comesBackAsItWasWritten) {
  std::vector<TumPose> poses(3);
  poses[0].stamp = 1'602'774'000'000'000'001;
  poses[0].position_enu_m = {1.5, -2.25, 1e-6};
  poses[0].q_flu_to_enu = quaternionFromRotationVector({0.1, -0.2, 2.5});
  poses[1].stamp = 1'602'774'000'999'999'999;
  poses[2].stamp = -1'500'000'000;
  writeTum(path_, poses);
  const auto read = readTum(path_);
  ASSERT_EQ(read.size(), 3U);
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].stamp, poses[i].stamp);
  }
  EXPECT_LT((read[0].position_enu_m - poses[0].position_enu_m).norm(), 1e-9);
  EXPECT_LT((read[0].q_flu_to_enu.coeffs() - poses[0].q_flu_to_enu.coeffs()).norm(), 2e-9);
}

TEST_F(Tum, writesTheOrderOfTheBenchmark) {
  TumPose pose;
  pose.stamp = 12'345'678'901;
  pose.position_enu_m = {1.0, 2.0, 3.0};
  pose.q_flu_to_enu = Quaternion(0.5, 0.1, 0.7, 0.5);
  writeTum(path_, {pose});
  std::string line;
  std::getline(std::ifstream(path_) >> std::ws, line);
  EXPECT_EQ(line, "12.345678901 1.000000000 2.000000000 3.000000000 0.100000000 0.700000000 0.500000000 0.500000000");
}

TEST_F(Tum, skipsCommentsAndBlankLines) {
  write("# timestamp tx ty tz qx qy qz qw\n\n1.5 1 2 3 0 0 0 1\n   \n2e0 1 2 3 0 0 0 1\n");
  EXPECT_THROW(readTum(path_), std::runtime_error) << "a stamp in exponential notation has lost its nanoseconds";
  write("# timestamp tx ty tz qx qy qz qw\n\n1.5 1 2 3 0 0 0 1\n   \n2 1 2 3 0 0 0 1");
  const auto poses = readTum(path_);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].stamp, 1'500'000'000);
  EXPECT_EQ(poses[1].stamp, 2'000'000'000);
}

TEST_F(Tum, namesFileAndLineOfWhatItCannotRead) {
  EXPECT_EQ(errorOf("1.5 1 2 3 0 0 0 1\n2.5 1 2 3 0 0 0\n"), path_ + ":2: 7 fields instead of 8");
  EXPECT_EQ(errorOf("1.5 1 2 nan 0 0 0 1\n"), path_ + ":1: 'nan' is not a number");
  EXPECT_EQ(errorOf("1.5 1 2 3 0 0 0 0\n"), path_ + ":1: the quaternion has not length one");
  EXPECT_EQ(errorOf("1.5.2 1 2 3 0 0 0 1\n"), path_ + ":1: '1.5.2' is not a time in seconds");
  EXPECT_EQ(errorOf("99999999999 1 2 3 0 0 0 1\n"), path_ + ":1: '99999999999' is not a time in seconds");
  EXPECT_EQ(errorOf("9999999999 1 2 3 0 0 0 1\n"), path_ + ":1: time of '9999999999' s is out of range");
}

TEST_F(Tum, namesThePathItCannotReachAndLeavesNothingBehind) {
  const std::string nowhere = ::testing::TempDir() + "slipnav_no_such_directory/x.tum";
  for (const auto& attempt :
       {+[](const std::string& path) { writeTum(path, {}); }, +[](const std::string& path) { readTum(path); }}) {
    try {
      attempt(nowhere);
      FAIL() << "no error";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(nowhere), std::string::npos);
    }
  }
}

TEST_F(Tum, takesTracks) {
  EstimateSample estimate;
  estimate.stamp = 5;
  estimate.position_enu_m = {1, 2, 3};
  estimate.q_flu_to_enu = quaternionFromRotationVector({0.0, 0.0, 1.0});
  ASSERT_EQ(tumPoses(EstimateTrack{estimate}).size(), 1U);
  EXPECT_EQ(tumPoses(EstimateTrack{estimate})[0].q_flu_to_enu.z(), estimate.q_flu_to_enu.z());
  TruthSample truth;
  truth.stamp = 6;
  truth.position_enu_m = {4, 5, 6};
  const auto poses = tumPoses(TruthTrack({truth}));
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].stamp, 6);
  EXPECT_EQ(poses[0].position_enu_m, Vector3(4, 5, 6));
  EXPECT_EQ(poses[0].q_flu_to_enu.w(), 1.0);
}

}  // namespace
}  // namespace slipnav
