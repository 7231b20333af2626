/// The configuration files and their reference say what the code says.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "config/config.h"
#include "config/markdown_writer.h"
#include "config/tuning.h"
#include "config/yaml_writer.h"

namespace slipnav {
namespace {

std::string contentOf(const std::string& path) {
  std::ifstream file(SLIPNAV_SOURCE_DIR "/" + path);
  EXPECT_TRUE(file.good()) << path << " cannot be read";
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// The first line in which two texts differ, "" where they are equal.
std::string firstDifference(const std::string& actual, const std::string& expected) {
  std::istringstream actual_lines(actual);
  std::istringstream expected_lines(expected);
  std::string actual_line;
  std::string expected_line;
  for (int number = 1; actual_lines || expected_lines; ++number) {
    const bool has_actual = static_cast<bool>(std::getline(actual_lines, actual_line));
    const bool has_expected = static_cast<bool>(std::getline(expected_lines, expected_line));
    if (has_actual != has_expected || (has_actual && actual_line != expected_line)) {
      return "line " + std::to_string(number) + ": '" + (has_actual ? actual_line : "") + "' should be '" +
             (has_expected ? expected_line : "") + "'";
    }
  }
  return "";
}

TEST(ConfigFiles, DefaultYamlHoldsTheDefaults) {
  EXPECT_EQ(firstDifference(contentOf("config/default.yaml"), toYaml(Config{})), "")
      << "regenerate it: ./run configuration > config/default.yaml";
}

TEST(ConfigFiles, ReferenceListsEveryParameter) {
  EXPECT_EQ(firstDifference(contentOf("doc/configuration.md"), toMarkdown(Config{}, tunableKeys())), "")
      << "regenerate it: ./run configuration --format markdown > doc/configuration.md";
}

TEST(ConfigFiles, EveryConfigurationLoads) {
  const std::filesystem::path for_another_program = "diagnostic_aggregator.yaml";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SLIPNAV_SOURCE_DIR "/config")) {
    if (entry.path().extension() == ".yaml" && entry.path().filename() != for_another_program) {
      EXPECT_NO_THROW(Config::load({entry.path().string()})) << entry.path();
      ++count;
    }
  }
  EXPECT_GE(count, 1);
}

}  // namespace
}  // namespace slipnav
