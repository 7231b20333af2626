#include "config/command_line.h"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "support/sample_parameters.h"

namespace slipnav {
namespace {

using test::messageOf;

CommandLine sample() {
  CommandLine command_line("drive", "Drives somewhere.");
  command_line.positional("BAG", "what to read")
      .flag("report", "write plots")
      .option("seed", "N", "random seed", "1")
      .choice("terrain", {"paved", "rough"}, "what to drive on", "rough")
      .repeated("config", "YAML", "configuration file");
  return command_line;
}

std::string complaint(const std::vector<std::string>& arguments) {
  return messageOf<UsageError>([&] { sample().parse(arguments); });
}

TEST(CommandLine, FillsInDefaults) {
  const Arguments arguments = sample().parse({"a.bag"});
  EXPECT_EQ(arguments.text("BAG"), "a.bag");
  EXPECT_FALSE(arguments.given("report"));
  EXPECT_FALSE(arguments.given("seed"));
  EXPECT_EQ(arguments.integer("seed"), 1);
  EXPECT_EQ(arguments.text("terrain"), "rough");
  EXPECT_TRUE(arguments.all("config").empty());
  EXPECT_FALSE(arguments.helpRequested());
}

TEST(CommandLine, TakesValuesInBothForms) {
  const Arguments arguments =
      sample().parse({"--seed", "-7", "--config=a", "a.bag", "--config", "b", "--report", "--terrain=paved"});
  EXPECT_EQ(arguments.integer("seed"), -7);
  EXPECT_EQ(arguments.all("config"), (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(arguments.given("report"));
  EXPECT_TRUE(arguments.given("seed"));
  EXPECT_EQ(arguments.text("terrain"), "paved");
}

TEST(CommandLine, OfAnOptionGivenTwiceTheLastWins) {
  EXPECT_EQ(sample().parse({"a.bag", "--seed", "2", "--seed", "3"}).integer("seed"), 3);
}

TEST(CommandLine, SkipsTheProgramNameOfMain) {
  const char* const argv[] = {"drive", "a.bag"};
  EXPECT_EQ(sample().parse(2, argv).text("BAG"), "a.bag");
}

TEST(CommandLine, TheLastPositionalMayTakeSeveral) {
  CommandLine command_line("drive", "Drives somewhere.");
  command_line.positionals("BAG", "what to read").option("out", "DIR", "where to");
  const Arguments arguments = command_line.parse({"a.bag", "--out", "here", "b.bag", "c.bag"});
  EXPECT_EQ(arguments.all("BAG"), (std::vector<std::string>{"a.bag", "b.bag", "c.bag"}));
  EXPECT_EQ(arguments.text("out"), "here");
  EXPECT_EQ(messageOf<UsageError>([&] { command_line.parse(std::vector<std::string>{}); }), "missing argument BAG");
  EXPECT_NE(command_line.help().find("usage: drive BAG... [options]"), std::string::npos);
}

TEST(CommandLine, ADoubleDashEndsTheOptions) { EXPECT_EQ(sample().parse({"--", "--help"}).text("BAG"), "--help"); }

TEST(CommandLine, NamesWrongArguments) {
  EXPECT_EQ(complaint({"a.bag", "--sed", "3"}), "unknown option '--sed', did you mean '--seed'?");
  EXPECT_EQ(complaint({"a.bag", "-s"}), "unknown option '-s', did you mean '--seed'?");
  EXPECT_EQ(complaint({"a.bag", "b.bag"}), "unexpected argument 'b.bag'");
  EXPECT_EQ(complaint({}), "missing argument BAG");
  EXPECT_EQ(complaint({"a.bag", "--seed"}), "--seed needs a value: N");
  EXPECT_EQ(complaint({"a.bag", "--seed", "--report"}), "--seed needs a value: N");
  EXPECT_EQ(complaint({"a.bag", "--report=yes"}), "--report takes no value");
  EXPECT_EQ(complaint({"a.bag", "--terrain", "sand"}), "--terrain must be paved or rough, not 'sand'");
}

TEST(CommandLine, NumbersAreCheckedWhenAskedFor) {
  const Arguments arguments = sample().parse({"a.bag", "--seed", "1e3"});
  EXPECT_EQ(arguments.number("seed"), 1000.0);
  EXPECT_EQ(messageOf<UsageError>([&] { arguments.integer("seed"); }), "--seed must be a whole number, not '1e3'");
  EXPECT_EQ(messageOf<UsageError>([&] { arguments.number("seed", {0.0, 10.0}); }), "--seed must be 0 to 10, not 1000");
  EXPECT_EQ(messageOf<UsageError>([&] { arguments.number("BAG"); }), "BAG must be a number, not 'a.bag'");
}

TEST(CommandLine, HelpIsAnsweredWhateverElseIsThere) {
  EXPECT_TRUE(sample().parse({"--nonsense", "--help"}).helpRequested());
}

TEST(CommandLine, HelpShowsEveryArgument) {
  EXPECT_EQ(sample().help(), R"(usage: drive BAG [options]

Drives somewhere.

  BAG                           what to read
  --report                      write plots
  --seed N                      random seed [1]
  --terrain paved|rough         what to drive on [rough]
  --config YAML                 configuration file; may be repeated
  --help                        show this text
)");
}

TEST(CommandLine, AskingForWhatWasNotDeclaredIsAProgrammingError) {
  EXPECT_THROW(sample().parse({"a.bag"}).text("speed"), std::logic_error);
}

TEST(RunGuarded, TurnsExceptionsIntoOneLineAndAStatus) {
  std::ostringstream errors;
  EXPECT_EQ(runGuarded("drive", errors, [] { return 0; }), 0);
  EXPECT_EQ(errors.str(), "");
  EXPECT_EQ(runGuarded("drive", errors, []() -> int { throw UsageError("bad --seed"); }), 2);
  EXPECT_EQ(runGuarded("drive", errors, []() -> int { throw std::runtime_error("disk full"); }), 1);
  EXPECT_EQ(errors.str(), "drive: bad --seed\ndrive: disk full\n");
}

}  // namespace
}  // namespace slipnav
