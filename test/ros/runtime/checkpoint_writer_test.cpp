#include "ros/runtime/checkpoint_writer.h"

#include <gtest/gtest.h>

namespace slipnav {
namespace {

Checkpoint checkpointOf(std::uint32_t session) {
  Checkpoint checkpoint;
  checkpoint.state.nav.stamp = 1'000'000'000;
  checkpoint.session = session;
  return checkpoint;
}

TEST(CheckpointWriter, TheLastOneIsWritten) {
  const std::string file = ::testing::TempDir() + "slipnav_checkpoint_writer_test";
  {
    CheckpointWriter writer(file);
    for (std::uint32_t i = 0; i < 50; ++i) {
      writer.write(checkpointOf(i));
    }
    writer.flush();
    EXPECT_GE(writer.status().written, 1U);
    EXPECT_EQ(loadCheckpoint(file).checkpoint->session, 49U);
    writer.write(checkpointOf(50));
  }
  EXPECT_EQ(loadCheckpoint(file).checkpoint->session, 50U);
  deleteCheckpoint(file);
}

TEST(CheckpointWriter, SaysWhatWentWrong) {
  CheckpointWriter writer("/nonexistent/checkpoint");
  writer.write(checkpointOf(1));
  writer.flush();
  EXPECT_EQ(writer.status().failed, 1U);
  EXPECT_NE(writer.status().problem.find("/nonexistent/checkpoint"), std::string::npos);
}

}  // namespace
}  // namespace slipnav
