#include "config/parameter_list.h"

#include <gtest/gtest.h>

#include "support/sample_parameters.h"

namespace slipnav {
namespace {

using test::SampleParameters;

TEST(ConfigParameterList, HoldsEveryFieldWithASingleValue) {
  const std::vector<ParameterInfo> parameters = listParameters(SampleParameters{});
  std::vector<std::string> texts;
  for (const ParameterInfo& parameter : parameters) {
    texts.push_back(parameter.key + ": " + toText(parameter.value));
  }
  const std::vector<std::string> expected = {"seed: 1", "enabled: true", "mode: \"off\"", "label: \"a b\"",
                                             "filter.gate: 3"};
  EXPECT_EQ(texts, expected);
}

TEST(ConfigParameterList, SaysWhatTheStructSays) {
  const std::vector<ParameterInfo> parameters = listParameters(SampleParameters{});
  EXPECT_EQ(parameters[0].range.max, 100.0);
  EXPECT_EQ(parameters[2].options, (std::vector<std::string>{"off", "advise", "active"}));
  EXPECT_EQ(parameters[4].range.min, 0.0);
  EXPECT_EQ(parameters[4].meaning, "innovation gate [sigma]");
}

}  // namespace
}  // namespace slipnav
