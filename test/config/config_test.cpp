#include "config/config.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "config/yaml_document.h"
#include "config/yaml_reader.h"
#include "config/yaml_writer.h"
#include "core/parameters/parameter_checker.h"
#include "support/sample_parameters.h"

namespace slipnav {
namespace {

using test::messageOf;

/// A file in the test's own temporary folder, removed at the end.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& content) : path_(::testing::TempDir() + "slipnav_" + name) {
    std::ofstream(path_) << content;
  }
  ~TemporaryFile() { std::remove(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

std::string complaint(const std::vector<std::string>& files, const std::vector<Override>& overrides = {}) {
  return messageOf<std::invalid_argument>([&] { Config::load(files, overrides); });
}

TEST(Config, WithoutFilesHasTheDefaults) {
  const Config config = Config::load({});
  EXPECT_EQ(config.planet, "earth");
  EXPECT_EQ(config.topics.imu, "imu/data");
  EXPECT_NO_THROW(checkParameters(config));
}

TEST(Config, EveryTopicIsCalledByItsBoundaryName) {
  const YAML::Node topics = parseYaml(toYaml(TopicNames{}), "");
  EXPECT_EQ(topics.size(), 23U);
  for (const auto& entry : topics) {
    EXPECT_EQ(entry.first.Scalar(), entry.second.Scalar());
  }
}

/// A configuration of an earlier release is read, and says what to write from now on.
TEST(Config, FormerNamesWorkAndAreNamed) {
  const TemporaryFile file("former.yaml", "planet: mars\ninitialization:\n  levelling_window_s: 7\n");
  const Config config = Config::load({file.path()}, {keyOverride("zero_motion.largest_velocity_std_mps=0.5")});
  EXPECT_EQ(config.initialization.leveling_window_s, 7.0);
  EXPECT_EQ(config.zero_motion.max_velocity_std_mps, 0.5);
  ASSERT_EQ(config.warnings.size(), 2U);
  EXPECT_EQ(config.warnings[0], file.path() +
                                    ":3: 'initialization.levelling_window_s' is now "
                                    "'initialization.leveling_window_s'; the former name works in this release only");
  EXPECT_NE(config.warnings[1].find("'zero_motion.max_velocity_std_mps'"), std::string::npos);
  EXPECT_TRUE(Config::load({}).warnings.empty());
}

TEST(Config, TheLaterOfAFormerAndAPresentNameWins) {
  const TemporaryFile former("former.yaml", "initialization: {levelling_window_s: 7}\n");
  const TemporaryFile present("present.yaml", "initialization: {leveling_window_s: 8}\n");
  EXPECT_EQ(Config::load({present.path(), former.path()}).initialization.leveling_window_s, 7.0);
  EXPECT_EQ(Config::load({former.path(), present.path()}).initialization.leveling_window_s, 8.0);
}

TEST(Config, AKeyByBothItsNamesIsRefused) {
  const TemporaryFile file("both.yaml", "initialization: {levelling_window_s: 7, leveling_window_s: 8}\n");
  EXPECT_NE(complaint({file.path()}).find("is the former name of 'initialization.leveling_window_s'"),
            std::string::npos);
}

TEST(Config, LaterFilesWin) {
  const TemporaryFile first("first.yaml", "planet: mars\ntopics: {imu/data: a, cmd_vel: b}\n");
  const TemporaryFile second("second.yaml", "topics:\n  imu/data: c\n");
  const Config config = Config::load({first.path(), second.path()});
  EXPECT_EQ(config.planet, "mars");
  EXPECT_EQ(config.topics.imu, "c");
  EXPECT_EQ(config.topics.cmd_vel, "b");
  EXPECT_EQ(Config::load({second.path(), first.path()}).topics.imu, "a");
}

TEST(Config, ErrorsNameTheFileThatHoldsThem) {
  const TemporaryFile good("good.yaml", "planet: mars\n");
  const TemporaryFile bad("bad.yaml", "# comment\nplanet: venus\n");
  EXPECT_EQ(complaint({good.path(), bad.path()}), bad.path() + ":2: 'planet' must be earth, mars or moon, not 'venus'");
  EXPECT_EQ(complaint({good.path(), "no/such.yaml"}), "no/such.yaml: cannot be read");
}

TEST(Config, OverridesWinOverFiles) {
  const TemporaryFile file("file.yaml", "planet: mars\ntopics: {imu/data: a}\n");
  const Config config = Config::load({file.path()}, {topicOverride("imu/data:=/imu"), keyOverride("planet=moon")});
  EXPECT_EQ(config.planet, "moon");
  EXPECT_EQ(config.topics.imu, "/imu");
}

TEST(Config, PapersForecastRefusesWhatContradictsIt) {
  const auto with = [](std::initializer_list<const char*> settings) {
    std::vector<Override> overrides;
    for (const char* setting : settings) {
      overrides.push_back(keyOverride(setting));
    }
    return complaint({}, overrides);
  };
  EXPECT_EQ(
      with({"forecast.schedule=paper"}),
      "'forecast.schedule: paper' contradicts 'forecast.bound: growth', it needs 'absolute'; config/paper.yaml has "
      "all that belongs to it");
  EXPECT_EQ(
      with({"forecast.schedule=paper", "forecast.bound=absolute"}),
      "'forecast.schedule: paper' contradicts 'stop.forecast_timeout_s', which must be above 'forecast.window_s': "
      "before the first forecast stops would become periodic");
  EXPECT_EQ(with({"forecast.schedule=paper", "forecast.bound=absolute", "stop.forecast_timeout_s=15.1"}),
            "nothing was thrown");
  EXPECT_EQ(with({"forecast.sigma_points.form=letter"}),
            "'forecast.sigma_points.form: letter' needs 'forecast.schedule: paper'");
}

TEST(Config, WrongOverridesAreNamed) {
  EXPECT_EQ(complaint({}, {topicOverride("imu/dta:=x")}),
            "--topic imu/dta:=x: unknown key 'topics.imu/dta', did you mean 'topics.imu/data'?");
  EXPECT_EQ(complaint({}, {keyOverride("planet=venus")}),
            "--set planet=venus: 'planet' must be earth, mars or moon, not 'venus'");
  EXPECT_EQ(complaint({}, {keyOverride("planet=[a")}).rfind("--set planet=[a: ", 0), 0U);
  EXPECT_EQ(messageOf<std::invalid_argument>([] { topicOverride("imu/data=x"); }),
            "--topic 'imu/data=x' must have the form name:=other");
  EXPECT_EQ(messageOf<std::invalid_argument>([] { keyOverride("=x"); }),
            "--set '=x' must have the form block.key=value");
}

TEST(Config, OverridesReachNestedBlocksAndHoldAnyYaml) {
  test::SampleParameters parameters;
  readParameters(toYamlNode(keyOverride("filter.updates=[wheel, zupt]")), parameters);
  EXPECT_EQ(parameters.filter.updates, (std::vector<std::string>{"wheel", "zupt"}));
}

TEST(Config, OptionsOfAnExecutableBecomeAConfiguration) {
  const TemporaryFile file("options.yaml", "planet: mars\n");
  CommandLine command_line("tool", "A tool.");
  declareConfigOptions(command_line);
  const Config config = configFromOptions(command_line.parse(
      {"--config", file.path(), "--topic", "gps/fix:=/gps", "--topic=cmd_vel:=/cmd", "--set", "planet=moon"}));
  EXPECT_EQ(config.topics.gps_fix, "/gps");
  EXPECT_EQ(config.topics.cmd_vel, "/cmd");
  EXPECT_EQ(config.planet, "moon");
}

}  // namespace
}  // namespace slipnav
