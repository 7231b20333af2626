#include "core/navigation/resumption.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "config/config.h"

namespace slipnav {
namespace {

class ResumptionTest : public ::testing::Test {
 protected:
  ResumptionTest() {
    params_.file = file_;
    Checkpoint checkpoint;
    checkpoint.state.nav.stamp = fromSeconds(1000.0);
    checkpoint.state.nav.position = {0.7, 0.1, 200.0};
    saveCheckpoint(params_.file, checkpoint);
  }
  ~ResumptionTest() override { deleteCheckpoint(file_); }

  Resumption resumption() const { return {Planet::byName("earth"), params_, Config().navigation().filter}; }

  const std::string file_ = ::testing::TempDir() + "slipnav_resumption_test";
  CheckpointParams params_;
};

TEST_F(ResumptionTest, GoesOnOnce) {
  Resumption resumption = this->resumption();
  ASSERT_TRUE(resumption.isPossible());
  const InitialState state = resumption.resume(fromSeconds(1003.0));
  EXPECT_EQ(state.nav.stamp, fromSeconds(1003.0));
  EXPECT_EQ(state.nav.position.latitude_rad, 0.7);
  EXPECT_DOUBLE_EQ(resumption.unwatched(), 3.0);
  EXPECT_FALSE(resumption.isPossible());
}

TEST_F(ResumptionTest, ACheckpointOfAnotherTimeIsGivenUp) {
  Resumption resumption = this->resumption();
  EXPECT_THROW(resumption.resume(fromSeconds(999.0)), std::invalid_argument);
  EXPECT_FALSE(resumption.isPossible());
}

TEST_F(ResumptionTest, WithoutAFileNothingIsPossible) {
  params_.file.clear();
  EXPECT_FALSE(resumption().isPossible());
}

TEST_F(ResumptionTest, TheFileOfALaunchServesWhereNoOtherIsNamed) {
  params_.launch_file = params_.file + "_launch";
  EXPECT_EQ(params_.place(), file_);
  EXPECT_TRUE(resumption().isPossible());
  params_.file.clear();
  EXPECT_EQ(params_.place(), params_.launch_file);
  EXPECT_FALSE(resumption().isPossible());
}

TEST_F(ResumptionTest, ADamagedFileIsNamed) {
  std::ofstream(file_, std::ios::app) << "x";
  const Resumption resumption = this->resumption();
  EXPECT_FALSE(resumption.isPossible());
  ASSERT_EQ(resumption.refused().size(), 1U);
  EXPECT_EQ(resumption.refused().front().find(file_), 0U);
}

TEST_F(ResumptionTest, DeletedFilesAreGone) {
  Resumption resumption = this->resumption();
  resumption.deleteFiles();
  EXPECT_FALSE(resumption.isPossible());
  EXPECT_FALSE(std::filesystem::exists(file_));
}

}  // namespace
}  // namespace slipnav
