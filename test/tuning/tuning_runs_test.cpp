#include "tuning/tuning_runs.h"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "sample_parameters.h"
#include "tuning/tuner.h"
#include "tuning_drive.h"

namespace slipnav::test {
namespace {

TEST(TuningRunsTest, runsAndLikelihoodsAreTextToTheLastBit) {
  TuningRun run{2, 17, Eigen::Vector3d(0.1, -1.0 / 3.0, 0.0)};
  const TuningRun read = runFromText(runText(run));
  EXPECT_EQ(read.drive, 2U);
  EXPECT_EQ(read.stretches, 17U);
  EXPECT_EQ(read.position, run.position);
  DriveLikelihood likelihood(2);
  likelihood[1][kLateral] = {3.0, 4.0, -1.0 / 7.0, 1e-300};
  const DriveLikelihood same = likelihoodFromText(likelihoodText(likelihood));
  ASSERT_EQ(same.size(), 2U);
  EXPECT_EQ(same[1][kLateral].log_likelihood, -1.0 / 7.0);
  EXPECT_EQ(same[1][kLateral].squared, 1e-300);
  EXPECT_EQ(same[0][kLateral].measurements, 0.0);
  for (const char* text : {"", "1", "1 2 x", "-"}) {
    EXPECT_THROW(runFromText(text), std::invalid_argument) << text;
  }
  EXPECT_THROW(likelihoodFromText("1 2 3"), std::invalid_argument);
}

TEST(TuningRunsTest, answersMayComeInAnyOrderAndMayFail) {
  DriveLikelihood first(1);
  first[0][kForwardSpeed].rows = 1.0;
  DriveLikelihood second(1);
  second[0][kForwardSpeed].rows = 2.0;
  std::istringstream answers("done 1 " + likelihoodText(second) + "\ndone 0 " + likelihoodText(first) +
                             "\nfailed 2 no such drive\n");
  std::ostringstream requests;
  RunExchange exchange(answers, requests);
  const TuningRun run{0, 1, Eigen::VectorXd::Zero(1)};
  EXPECT_EQ(exchange.ask(run)[0][kForwardSpeed].rows, 1.0);
  EXPECT_EQ(exchange.ask(run)[0][kForwardSpeed].rows, 2.0);
  EXPECT_EQ(messageOf<std::runtime_error>([&] { exchange.ask(run); }), "no such drive");
  EXPECT_THROW(exchange.ask(run), std::runtime_error);
  EXPECT_EQ(requests.str().substr(0, requests.str().find('\n')), "run 0 " + runText(run));
}

TEST(TuningRunsTest, elsewhereGivesTheSameBits) {
  const Config config = tuningConfig(3, 30.0);
  TuningDrive drive = simulateTuningDrive(config);
  addWheelNoise(0.04, drive);
  const std::vector<Knob> knobs = tuningKnobs(config, {"wheel.speed_std_mps"});
  TuningRuns elsewhere;
  elsewhere.slots = 3;
  elsewhere.elsewhere = [&](const TuningRun& asked) {
    const TuningRun run = runFromText(runText(asked));
    return likelihoodFromText(
        likelihoodText(likelihoodOf(drive, withKnobs(drive.config, knobs, run.position), run.stretches)));
  };
  const auto watcher = [](const TuningProgress&) {};
  const TuningResult here = tune(knobs, {drive}, watcher);
  const TuningResult there = tune(knobs, {drive}, watcher, elsewhere);
  EXPECT_EQ(here.knobs.front().position, there.knobs.front().position);
  EXPECT_EQ(here.held_out.gain.value, there.held_out.gain.value);
}

}  // namespace
}  // namespace slipnav::test
