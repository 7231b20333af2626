#include "core/stopping/stop_latch.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace slipnav {
namespace {

class StopLatchFile : public ::testing::Test {
 protected:
  StopLatchFile() { std::filesystem::create_directories(folder_); }
  ~StopLatchFile() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& text) const { std::ofstream(file_, std::ios::binary) << text; }

  std::string folder_ = ::testing::TempDir() + "/slipnav_stop_latch";
  std::string file_ = folder_ + "/latch";
};

TEST_F(StopLatchFile, HoldsWhatWasSaid) {
  for (const bool emergency_stop : {true, false}) {
    for (const bool overridden : {true, false}) {
      saveStopLatch(file_, {emergency_stop, overridden});
      const LoadedStopLatch loaded = loadStopLatch(file_);
      EXPECT_EQ(loaded.latch.emergency_stop, emergency_stop);
      EXPECT_EQ(loaded.latch.overridden, overridden);
      EXPECT_EQ(loaded.problem, "");
    }
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1) << "nothing is left beside it";
}

TEST_F(StopLatchFile, OneThatIsNotThereHoldsNothing) {
  const LoadedStopLatch loaded = loadStopLatch(file_);
  EXPECT_FALSE(loaded.latch.emergency_stop);
  EXPECT_FALSE(loaded.latch.overridden);
  EXPECT_EQ(loaded.problem, "");
}

TEST_F(StopLatchFile, OneThatCannotBeUnderstoodIsAnEmergencyStop) {
  const std::string sound = formatStopLatch({false, true});
  for (std::size_t size = 0; size < sound.size(); ++size) {
    write(sound.substr(0, size));
    EXPECT_TRUE(loadStopLatch(file_).latch.emergency_stop) << size;
    EXPECT_NE(loadStopLatch(file_).problem, "") << size;
  }
  std::filesystem::remove(file_);
  std::filesystem::create_directory(file_);
  EXPECT_TRUE(loadStopLatch(file_).latch.emergency_stop) << "a folder";
}

TEST_F(StopLatchFile, OneThatCannotBeWrittenIsNamed) {
  try {
    saveStopLatch(folder_ + "/missing/latch", {true, false});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/missing/latch: No such file"), std::string::npos) << error.what();
  }
}

TEST_F(StopLatchFile, LeavesNoFileOpen) {
  const auto open_files = [] { return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}); };
  saveStopLatch(file_, {});
  const auto before = open_files();
  saveStopLatch(file_, {true, false});
  EXPECT_EQ(open_files(), before);
}

}  // namespace
}  // namespace slipnav
