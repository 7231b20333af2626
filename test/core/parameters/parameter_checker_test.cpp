#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "core/parameters/parameter_checker.h"
#include "support/sample_parameters.h"

namespace slipnav {
namespace {

using test::messageOf;
using test::SampleParameters;

std::string complaint(const SampleParameters& parameters) {
  return messageOf<std::invalid_argument>([&] { checkParameters(parameters); });
}

TEST(ConfigChecker, RangesInWords) {
  EXPECT_EQ(describeRange({0.0, 1.0}), "0 to 1");
  EXPECT_EQ(describeRange({0.5}), "at least 0.5");
  EXPECT_EQ(describeRange({-std::numeric_limits<double>::infinity(), 2.0}), "at most 2");
  EXPECT_EQ(describeRange({}), "");
}

TEST(ConfigChecker, DefaultsPass) { EXPECT_NO_THROW(checkParameters(SampleParameters{})); }

TEST(ConfigChecker, BoundsBelongToTheRange) {
  SampleParameters parameters;
  parameters.seed = 100;
  parameters.filter.gate = 0.0;
  EXPECT_NO_THROW(checkParameters(parameters));
}

TEST(ConfigChecker, NamesANumberOutOfRange) {
  SampleParameters parameters;
  parameters.filter.gate = -1.0;
  EXPECT_EQ(complaint(parameters), "'filter.gate' must be at least 0, not -1");
}

TEST(ConfigChecker, NamesAnIntegerOutOfRange) {
  SampleParameters parameters;
  parameters.seed = 101;
  EXPECT_EQ(complaint(parameters), "'seed' must be 0 to 100, not 101");
}

TEST(ConfigChecker, RefusesNumbersThatAreNotFinite) {
  SampleParameters parameters;
  parameters.filter.gate = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(complaint(parameters), "'filter.gate' must be a finite number, not nan");
  parameters.filter.gate = std::numeric_limits<double>::infinity();
  EXPECT_EQ(complaint(parameters), "'filter.gate' must be a finite number, not inf");
}

TEST(ConfigChecker, NamesTheItemOfAList) {
  SampleParameters parameters;
  parameters.filter.lever_m[1] = 11.0;
  EXPECT_EQ(complaint(parameters), "'filter.lever_m[1]' must be -10 to 10, not 11");
  parameters = {};
  parameters.wheels[1].radius_m = 0.0;
  EXPECT_EQ(complaint(parameters), "'wheels[1].radius_m' must be 0.01 to 1, not 0");
}

TEST(ConfigChecker, NamesTheChoices) {
  SampleParameters parameters;
  parameters.mode = "on";
  EXPECT_EQ(complaint(parameters), "'mode' must be off, advise or active, not 'on'");
  parameters = {};
  parameters.filter.updates = {"wheel", "gnss"};
  EXPECT_EQ(complaint(parameters), "'filter.updates[1]' must be wheel or zupt, not 'gnss'");
}

}  // namespace
}  // namespace slipnav
