/// The configuration files and their reference say what the code says.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "slipnav/config/config.h"
#include "slipnav/config/markdown_writer.h"
#include "slipnav/config/yaml_writer.h"

namespace slipnav {
namespace {

std::string contentOf(const std::string& path) {
  std::ifstream file(SLIPNAV_SOURCE_DIR "/" + path);
  EXPECT_TRUE(file.good()) << path << " cannot be read";
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(ConfigFiles, DefaultYamlHoldsTheDefaults) {
  EXPECT_EQ(contentOf("config/default.yaml"), toYaml(Config{}))
      << "regenerate it: ./run configuration > config/default.yaml";
}

TEST(ConfigFiles, ReferenceListsEveryParameter) {
  EXPECT_EQ(contentOf("doc/configuration.md"), toMarkdown(Config{}))
      << "regenerate it: ./run configuration --format markdown > doc/configuration.md";
}

TEST(ConfigFiles, EveryConfigurationLoads) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SLIPNAV_SOURCE_DIR "/config")) {
    if (entry.path().extension() == ".yaml") {
      EXPECT_NO_THROW(Config::load({entry.path().string()})) << entry.path();
      ++count;
    }
  }
  EXPECT_GE(count, 1);
}

}  // namespace
}  // namespace slipnav
