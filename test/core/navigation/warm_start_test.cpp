#include "core/navigation/warm_start.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "config/config.h"

namespace slipnav {
namespace {

class WarmStartTest : public ::testing::Test {
 protected:
  WarmStartTest() {
    params_.file = file_;
    Checkpoint checkpoint;
    checkpoint.state.nav.stamp = fromSeconds(1000.0);
    checkpoint.state.nav.position = {0.7, 0.1, 200.0};
    saveCheckpoint(params_.file, checkpoint);
  }
  ~WarmStartTest() override { deleteCheckpoint(file_); }

  WarmStart warm_start() const { return {Planet::byName("earth"), params_, Config().navigation().filter}; }

  const std::string file_ = ::testing::TempDir() + "slipnav_warm_start_test";
  CheckpointParams params_;
};

TEST_F(WarmStartTest, GoesOnOnce) {
  WarmStart warm_start = this->warm_start();
  ASSERT_TRUE(warm_start.isPossible());
  const InitialState state = warm_start.resume(fromSeconds(1003.0));
  EXPECT_EQ(state.nav.stamp, fromSeconds(1003.0));
  EXPECT_EQ(state.nav.position.latitude_rad, 0.7);
  EXPECT_DOUBLE_EQ(warm_start.unwatched(), 3.0);
  EXPECT_FALSE(warm_start.isPossible());
}

TEST_F(WarmStartTest, ACheckpointOfAnotherTimeIsGivenUp) {
  WarmStart warm_start = this->warm_start();
  EXPECT_THROW(warm_start.resume(fromSeconds(999.0)), std::invalid_argument);
  EXPECT_FALSE(warm_start.isPossible());
}

TEST_F(WarmStartTest, WithoutAFileNothingIsPossible) {
  params_.file.clear();
  EXPECT_FALSE(warm_start().isPossible());
}

TEST_F(WarmStartTest, TheFileOfALaunchServesWhereNoOtherIsNamed) {
  params_.launch_file = params_.file + "_launch";
  EXPECT_EQ(params_.place(), file_);
  EXPECT_TRUE(warm_start().isPossible());
  params_.file.clear();
  EXPECT_EQ(params_.place(), params_.launch_file);
  EXPECT_FALSE(warm_start().isPossible());
}

TEST_F(WarmStartTest, ADamagedFileIsNamed) {
  std::ofstream(file_, std::ios::app) << "x";
  const WarmStart warm_start = this->warm_start();
  EXPECT_FALSE(warm_start.isPossible());
  ASSERT_EQ(warm_start.refused().size(), 1U);
  EXPECT_EQ(warm_start.refused().front().find(file_), 0U);
}

TEST_F(WarmStartTest, DeletedFilesAreGone) {
  WarmStart warm_start = this->warm_start();
  warm_start.deleteFiles();
  EXPECT_FALSE(warm_start.isPossible());
  EXPECT_FALSE(std::filesystem::exists(file_));
}

}  // namespace
}  // namespace slipnav
