#include "config/yaml_reader.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "config/yaml_document.h"
#include "support/sample_parameters.h"

namespace slipnav {
namespace {

using test::messageOf;
using test::SampleParameters;

SampleParameters read(const std::string& yaml) {
  SampleParameters parameters;
  readParameters(parseYaml(yaml, "a.yaml"), parameters, "a.yaml");
  return parameters;
}

std::string complaint(const std::string& yaml) {
  return messageOf<std::invalid_argument>([&] { read(yaml); });
}

TEST(ConfigYamlReader, ReadsEveryKindOfField) {
  const SampleParameters parameters = read(R"(
seed: 42
enabled: false
mode: active
label: "x: y"
filter: {gate: 1e-9, updates: [], lever_m: [0, -1.5, 2]}
wheels:
  - {name: only, radius_m: 0.25}
)");
  EXPECT_EQ(parameters.seed, 42);
  EXPECT_FALSE(parameters.enabled);
  EXPECT_EQ(parameters.mode, "active");
  EXPECT_EQ(parameters.label, "x: y");
  EXPECT_EQ(parameters.filter.gate, 1e-9);
  EXPECT_TRUE(parameters.filter.updates.empty());
  EXPECT_EQ(parameters.filter.lever_m, (std::vector<double>{0.0, -1.5, 2.0}));
  ASSERT_EQ(parameters.wheels.size(), 1U);
  EXPECT_EQ(parameters.wheels[0].name, "only");
  EXPECT_EQ(parameters.wheels[0].radius_m, 0.25);
}

TEST(ConfigYamlReader, AbsentKeysKeepTheirValue) {
  const SampleParameters parameters = read("filter:\n  gate: 5\n");
  EXPECT_EQ(parameters.filter.gate, 5.0);
  EXPECT_EQ(parameters.filter.updates, std::vector<std::string>{"wheel"});
  EXPECT_EQ(parameters.seed, 1);
  EXPECT_EQ(parameters.wheels.size(), 2U);
}

TEST(ConfigYamlReader, EmptyDocumentsAndBlocksChangeNothing) {
  EXPECT_EQ(read("").seed, 1);
  EXPECT_EQ(read("filter:\n").filter.gate, 3.0);
}

TEST(ConfigYamlReader, AListReplacesTheWholeDefault) {
  const SampleParameters parameters = read("wheels: [{name: front}]");
  ASSERT_EQ(parameters.wheels.size(), 1U);
  EXPECT_EQ(parameters.wheels[0].radius_m, 0.1) << "the item's own default, not that of the wheel before";
}

TEST(ConfigYamlReader, AWordThatYamlTakesForFalseIsStillAWord) { EXPECT_EQ(read("mode: off").mode, "off"); }

TEST(ConfigYamlReader, UnknownKeysNameFileLineAndNearestKey) {
  EXPECT_EQ(complaint("seed: 2\nfilter:\n  upadtes: []\n"),
            "a.yaml:3: unknown key 'filter.upadtes', did you mean 'filter.updates'?");
  EXPECT_EQ(complaint("sed: 2"), "a.yaml:1: unknown key 'sed', did you mean 'seed'?");
  EXPECT_EQ(complaint("wheels: [{radius: 1}]"),
            "a.yaml:1: unknown key 'wheels[0].radius', did you mean 'wheels[0].radius_m'?");
}

TEST(ConfigYamlReader, AKeyInTheWrongBlockIsSentToTheRightOne) {
  EXPECT_EQ(complaint("gate: 2"), "a.yaml:1: unknown key 'gate', did you mean 'filter.gate'?");
}

TEST(ConfigYamlReader, TypeErrorsSayWhatStandsThere) {
  EXPECT_EQ(complaint("filter: {gate: wide}"), "a.yaml:1: 'filter.gate' must be a finite number, not 'wide'");
  EXPECT_EQ(complaint("filter: {gate: [1]}"), "a.yaml:1: 'filter.gate' must be a finite number, not a list");
  EXPECT_EQ(complaint("filter: {gate: }"), "a.yaml:1: 'filter.gate' must be a finite number, not nothing");
  EXPECT_EQ(complaint("seed: 1.5"), "a.yaml:1: 'seed' must be a whole number, not '1.5'");
  EXPECT_EQ(complaint("enabled: maybe"), "a.yaml:1: 'enabled' must be true or false, not 'maybe'");
  EXPECT_EQ(complaint("label: {a: b}"), "a.yaml:1: 'label' must be a text, not a block");
  EXPECT_EQ(complaint("filter: 3"), "a.yaml:1: 'filter' must be a block of keys, not '3'");
  EXPECT_EQ(complaint("filter: {updates: wheel}"), "a.yaml:1: 'filter.updates' must be a list, not 'wheel'");
  EXPECT_EQ(complaint("wheels: 4"), "a.yaml:1: 'wheels' must be a list, not '4'");
  EXPECT_EQ(complaint("wheels: [4]"), "a.yaml:1: 'wheels[0]' must be a block of keys, not '4'");
  EXPECT_EQ(complaint("[1, 2]"), "a.yaml:1: the document must be a block of keys, not a list");
}

TEST(ConfigYamlReader, ValuesAreCheckedAsTheyAreRead) {
  EXPECT_EQ(complaint("filter:\n  gate: -1"), "a.yaml:2: 'filter.gate' must be at least 0, not -1");
  EXPECT_EQ(complaint("seed: 101"), "a.yaml:1: 'seed' must be 0 to 100, not 101");
  EXPECT_EQ(complaint("filter: {gate: .inf}"), "a.yaml:1: 'filter.gate' must be a finite number, not '.inf'");
  EXPECT_EQ(complaint("filter: {lever_m: [1, .nan, 3]}"),
            "a.yaml:1: 'filter.lever_m[1]' must be a finite number, not '.nan'");
  EXPECT_EQ(complaint("filter: {lever_m: [1, 2]}"), "a.yaml:1: 'filter.lever_m' must have 3 numbers, not 2");
  EXPECT_EQ(complaint("mode: on"), "a.yaml:1: 'mode' must be off, advise or active, not 'on'");
  EXPECT_EQ(complaint("filter: {updates: [gnss]}"), "a.yaml:1: 'filter.updates[0]' must be wheel or zupt, not 'gnss'");
}

TEST(ConfigYamlReader, AKeyGivenTwiceIsAnError) {
  EXPECT_EQ(complaint("filter:\n  gate: 1\n  gate: 2\n"), "a.yaml:3: key 'filter.gate' is given twice");
}

TEST(ConfigYamlReader, AValueThatIsRefusedChangesNothing) {
  SampleParameters parameters;
  EXPECT_THROW(readParameters(parseYaml("filter: {lever_m: [7, 8, 99]}", ""), parameters), std::invalid_argument);
  EXPECT_EQ(parameters.filter.lever_m, (std::vector<double>{1.0, 2.0, 3.0}));
}

TEST(ConfigYamlDocument, SyntaxErrorsNameTheirPlace) {
  const std::string message = messageOf<std::invalid_argument>([] { parseYaml("a: 1\nb: [1, 2", "b.yaml"); });
  EXPECT_EQ(message.rfind("b.yaml:2: ", 0), 0U) << message;
}

TEST(ConfigYamlDocument, AMissingFileIsNamed) {
  EXPECT_EQ(messageOf<std::invalid_argument>([] { loadYamlFile("no/such.yaml"); }), "no/such.yaml: cannot be read");
}

TEST(ConfigYamlDocument, MergingIsDeepForMapsAndReplacesTheRest) {
  const YAML::Node base = parseYaml("a: {x: 1, y: [1, 2, 3]}\nb: 5", "");
  const YAML::Node overlay = parseYaml("a: {y: [9], z: 4}\nc: 6", "");
  const YAML::Node merged = mergeYaml(base, overlay);
  EXPECT_EQ(merged["a"]["x"].as<int>(), 1);
  EXPECT_EQ(merged["a"]["y"].size(), 1U);
  EXPECT_EQ(merged["a"]["z"].as<int>(), 4);
  EXPECT_EQ(merged["b"].as<int>(), 5);
  EXPECT_EQ(merged["c"].as<int>(), 6);
  EXPECT_EQ(base["a"]["y"].size(), 3U) << "the arguments stay as they were";
  EXPECT_FALSE(base["c"]);
}

}  // namespace
}  // namespace slipnav
