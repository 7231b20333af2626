#include "core/base/atomic_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>

namespace slipnav {
namespace {

/// Numbers as they are written in most of Europe.
class DecimalComma : public std::numpunct<char> {
 protected:
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

std::string contentOf(const std::string& path) {
  std::ostringstream content;
  content << std::ifstream(path).rdbuf();
  return content.str();
}

class AtomicFileTest : public ::testing::Test {
 protected:
  AtomicFileTest() { std::ofstream(path_) << "before"; }
  ~AtomicFileTest() override { std::filesystem::remove(path_); }

  const std::string path_ = ::testing::TempDir() + "slipnav_atomic_file_test";
};

TEST_F(AtomicFileTest, AppearsWhenItIsComplete) {
  {
    AtomicFile file(path_);
    file.stream() << "after";
    EXPECT_EQ(contentOf(path_), "before");
    file.commit();
  }
  EXPECT_EQ(contentOf(path_), "after");
}

TEST_F(AtomicFileTest, GivenUpLeavesNoTrace) {
  { AtomicFile(path_).stream() << "after"; }
  EXPECT_EQ(contentOf(path_), "before");
  EXPECT_FALSE(std::filesystem::exists(path_ + ".part"));
}

TEST_F(AtomicFileTest, NumbersAreWrittenTheSameEverywhere) {
  const std::locale here = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  {
    AtomicFile file(path_);
    file.stream() << 12345.5;
    file.commit();
  }
  std::locale::global(here);
  EXPECT_EQ(contentOf(path_), "12345.5");
}

TEST_F(AtomicFileTest, AFolderThatIsNotThereIsNamed) {
  const std::string path = path_ + "_missing/file";
  try {
    AtomicFile file(path);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
  }
}

TEST_F(AtomicFileTest, FoldersAreMadeWithTheirParents) {
  const std::string folder = path_ + "_folder";
  createDirectories(folder + "/a/b");
  EXPECT_TRUE(std::filesystem::is_directory(folder + "/a/b"));
  createDirectories(folder + "/a/b");
  std::filesystem::remove_all(folder);
  EXPECT_THROW(createDirectories(path_), std::runtime_error) << "a file";
}

}  // namespace
}  // namespace slipnav
