#include <gtest/gtest.h>

#include "config/markdown_writer.h"
#include "config/yaml_document.h"
#include "config/yaml_reader.h"
#include "config/yaml_writer.h"
#include "support/sample_parameters.h"

namespace slipnav {
namespace {

using test::SampleItem;
using test::SampleParameters;

TEST(ConfigYamlWriter, WritesEveryKeyWithItsMeaning) {
  EXPECT_EQ(toYaml(SampleParameters{}), R"(# random seed (0 to 100)
seed: 1
# whether anything happens
enabled: true
# what happens (off, advise or active)
mode: "off"
# free text
label: "a b"

# the filter
filter:
  # innovation gate [sigma] (at least 0)
  gate: 3
  # which measurements are used (any of wheel or zupt)
  updates: [wheel]
  # lever arm [m] (-10 to 10)
  lever_m: [1, 2, 3]

# the wheels
wheels:
  # what the item is called
  - name: left
    # radius [m] (0.01 to 1)
    radius_m: 0.2
  - name: right
    radius_m: 0.3
)");
}

TEST(ConfigYamlWriter, WhatIsWrittenReadsBackExactly) {
  SampleParameters written;
  written.seed = 99;
  written.enabled = false;
  written.mode = "advise";
  written.label = "quote \" backslash \\ colon: hash # end";
  written.filter.gate = 1.0 / 3.0;
  written.filter.updates = {};
  written.filter.lever_m = {1e-9, -0.1, 7.292115e-5};
  written.wheels = {SampleItem{"yes", 0.11}, SampleItem{"", 0.3}, SampleItem{"3", 1.0}};

  SampleParameters read;
  readParameters(parseYaml(toYaml(written), "written"), read, "written");

  EXPECT_EQ(read.seed, written.seed);
  EXPECT_EQ(read.enabled, written.enabled);
  EXPECT_EQ(read.mode, written.mode);
  EXPECT_EQ(read.label, written.label);
  EXPECT_EQ(read.filter.gate, written.filter.gate);
  EXPECT_EQ(read.filter.updates, written.filter.updates);
  EXPECT_EQ(read.filter.lever_m, written.filter.lever_m);
  ASSERT_EQ(read.wheels.size(), written.wheels.size());
  for (std::size_t i = 0; i < read.wheels.size(); ++i) {
    EXPECT_EQ(read.wheels[i].name, written.wheels[i].name);
    EXPECT_EQ(read.wheels[i].radius_m, written.wheels[i].radius_m);
  }
}

TEST(ConfigYamlWriter, AnEmptyListStaysAList) {
  SampleParameters written;
  written.wheels.clear();
  SampleParameters read;
  readParameters(parseYaml(toYaml(written), ""), read);
  EXPECT_TRUE(read.wheels.empty());
}

TEST(ConfigYamlWriter, QuotesOnlyWhatYamlWouldMistake) {
  EXPECT_EQ(yamlScalar("/dead_reckoning/joint_states"), "/dead_reckoning/joint_states");
  EXPECT_EQ(yamlScalar("front_left"), "front_left");
  for (const char* word : {"off", "No", "TRUE", "null", "y", "", "1e-3", "-x", "a: b", "#", "~"}) {
    EXPECT_EQ(yamlScalar(word).front(), '"') << word;
  }
}

struct LongMeaning {
  double x = 1.0;
  void visit(ParameterVisitor& v) {
    v.number("x", x, {},
             "a meaning that goes on and on until it no longer fits into one line of the file, so that it "
             "has to be broken into two lines");
  }
};

TEST(ConfigYamlWriter, LongCommentsAreWrapped) {
  const std::string yaml = toYaml(LongMeaning{});
  std::size_t begin = 0;
  int lines = 0;
  for (std::size_t end = yaml.find('\n'); end != std::string::npos; end = yaml.find('\n', begin)) {
    EXPECT_LE(end - begin, 110U);
    begin = end + 1;
    ++lines;
  }
  EXPECT_EQ(lines, 3);
}

TEST(ConfigMarkdownWriter, OneTableForEachBlock) {
  EXPECT_EQ(toMarkdown(SampleParameters{}), R"(# Configuration reference

| key | default | allowed | meaning |
|---|---|---|---|
| `seed` | `1` | 0 to 100 | random seed |
| `enabled` | `true` | true or false | whether anything happens |
| `mode` | `off` | off, advise or active | what happens |
| `label` | `a b` |  | free text |

## `filter`

the filter

| key | default | allowed | meaning |
|---|---|---|---|
| `gate` | `3` | at least 0 | innovation gate [sigma] |
| `updates` | `[wheel]` | wheel or zupt | which measurements are used |
| `lever_m` | `[1, 2, 3]` | -10 to 10 | lever arm [m] |

## `wheels[]`

the wheels

| key | default | allowed | meaning |
|---|---|---|---|
| `name` | `left` |  | what the item is called |
| `radius_m` | `0.2` | 0.01 to 1 | radius [m] |

)");
}

TEST(ConfigMarkdownWriter, AnEmptyListStillShowsItsKeys) {
  SampleParameters parameters;
  parameters.wheels.clear();
  EXPECT_NE(toMarkdown(parameters).find("| `name` | `unnamed` |"), std::string::npos);
}

}  // namespace
}  // namespace slipnav
