#include "slipnav/core/ins/ins_engine.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "random_states.h"
#include "simulation/random.h"
#include "slipnav/core/base/rotation.h"

namespace slipnav::test {
namespace {

constexpr Nanoseconds kStart = 1'600'000'000'000'000'000;
constexpr Nanoseconds kPeriod = 20'000'000;

const Planet& earth() {
  static const Planet planet = Planet::byName("earth");
  return planet;
}

NavigationState stateAt(Nanoseconds stamp) {
  NavigationState state;
  state.stamp = stamp;
  state.q_b_to_n = q_b_to_n_fromEuler(0.05, 0.1, 1.0);
  state.position = {degToRad(40.0), degToRad(-80.0), 300.0};
  return state;
}

std::vector<ImuSample> samples(int count) {
  sim::RandomStream random(1, "imu");
  std::vector<ImuSample> result;
  for (int i = 0; i < count; ++i) {
    result.push_back({kStart + i * kPeriod, Vector3(0.0, 0.0, -9.8) + random.normal3(), 0.2 * random.normal3()});
  }
  return result;
}

std::vector<InsStep> drain(InsEngine& engine) {
  std::vector<InsStep> steps;
  while (const std::optional<InsStep> step = engine.step()) {
    steps.push_back(*step);
  }
  return steps;
}

/// An engine that starts at the first sample and has got all of them.
InsEngine filled(const std::vector<ImuSample>& imu) {
  InsEngine engine(earth(), {});
  engine.initialize(stateAt(imu.front().stamp));
  for (const ImuSample& sample : imu) {
    EXPECT_TRUE(isAccepted(engine.push(sample)));
  }
  return engine;
}

TEST(InsEngine, MechanizesEachIntervalOnce) {
  const std::vector<ImuSample> imu = samples(20);
  InsEngine engine = filled(imu);
  const std::vector<InsStep> steps = drain(engine);
  ASSERT_EQ(steps.size(), 19U);
  const Strapdown strapdown(earth());
  NavigationState state = stateAt(kStart);
  ImuInterval previous;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const ImuInterval interval{imu[i + 1].f_ib_b, imu[i + 1].omega_ib_b, toSeconds(kPeriod)};
    state = strapdown.propagate(state, previous, interval, imu[i + 1].stamp);
    previous = interval;
    EXPECT_EQ(steps[i].epoch, 0U);
    EXPECT_EQ(steps[i].start, imu[i].stamp);
    EXPECT_TRUE(sameState(steps[i].state, state));
    EXPECT_EQ(steps[i].gap_s, 0.0);
  }
  EXPECT_FALSE(engine.step());
}

TEST(InsEngine, StepsAreFreeOfTheBiases) {
  const std::vector<ImuSample> imu = samples(3);
  InsEngine engine(earth(), {});
  NavigationState start = stateAt(kStart);
  start.accel_bias_b = Vector3(0.1, 0.2, 0.3);
  start.gyro_bias_b = Vector3(0.01, 0.02, 0.03);
  engine.initialize(start);
  for (const ImuSample& sample : imu) {
    engine.push(sample);
  }
  const InsStep step = engine.step().value();
  EXPECT_EQ(step.f_ib_b, imu[1].f_ib_b - start.accel_bias_b);
  EXPECT_EQ(step.omega_ib_b, imu[1].omega_ib_b - start.gyro_bias_b);
}

TEST(InsEngine, StartsInsideAnInterval) {
  const std::vector<ImuSample> imu = samples(5);
  InsEngine engine(earth(), {});
  for (const ImuSample& sample : imu) {
    engine.push(sample);
  }
  EXPECT_FALSE(engine.step());  // no initial state
  EXPECT_FALSE(engine.isInitialized());
  engine.initialize(stateAt(kStart + kPeriod + kPeriod / 4));
  const std::vector<InsStep> steps = drain(engine);
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps[0].start, kStart + kPeriod + kPeriod / 4);
  EXPECT_EQ(steps[0].state.stamp, imu[2].stamp);
  EXPECT_EQ(steps[1].start, imu[2].stamp);
}

/// Going back to a step and saying what was said there already changes nothing, bit for bit.
TEST(InsEngine, RewindGivesTheSameAsTheSequentialRun) {
  const std::vector<ImuSample> imu = samples(200);
  InsEngine engine = filled(imu);
  const std::vector<InsStep> sequential = drain(engine);
  for (const std::size_t back_to : {150U, 150U, 170U, 198U}) {
    ASSERT_TRUE(engine.correct({7, sequential[back_to].state}));
    const std::vector<InsStep> again = drain(engine);
    ASSERT_EQ(again.size(), sequential.size() - back_to - 1);
    for (std::size_t i = 0; i < again.size(); ++i) {
      EXPECT_EQ(again[i].start, sequential[back_to + 1 + i].start);
      EXPECT_EQ(again[i].epoch, 7U);
      EXPECT_TRUE(sameState(again[i].state, sequential[back_to + 1 + i].state));
    }
  }
}

TEST(InsEngine, GoesOnFromTheCorrectedState) {
  const std::vector<ImuSample> imu = samples(50);
  InsEngine engine = filled(imu);
  const std::vector<InsStep> steps = drain(engine);
  Correction correction{1, steps[30].state};
  correction.state.v_eb_n += Vector3(1.0, 2.0, 3.0);
  correction.state.accel_bias_b = Vector3(0.1, 0.0, 0.0);
  ASSERT_TRUE(engine.correct(correction));
  const ImuInterval before{imu[31].f_ib_b, imu[31].omega_ib_b, toSeconds(kPeriod)};
  const ImuInterval after{imu[32].f_ib_b, imu[32].omega_ib_b, toSeconds(kPeriod)};
  const NavigationState expected = Strapdown(earth()).propagate(correction.state, before, after, imu[32].stamp);
  const InsStep step = engine.step().value();
  EXPECT_EQ(step.start, steps[30].state.stamp);
  EXPECT_TRUE(sameState(step.state, expected));
  EXPECT_EQ(step.f_ib_b, imu[32].f_ib_b - correction.state.accel_bias_b);
}

/// Corrections that come late give what they would have given in time.
TEST(InsEngine, LateCorrectionsAreAsGoodAsTimelyOnes) {
  const std::vector<ImuSample> imu = samples(100);
  const auto correctionOf = [](const InsStep& step) {
    Correction correction{step.epoch + 1, step.state};
    correction.state.v_eb_n *= 0.5;
    correction.state.gyro_bias_b += Vector3(1e-4, 0.0, 0.0);
    return correction;
  };
  InsEngine timely(earth(), {});
  timely.initialize(stateAt(kStart));
  NavigationState last_timely;
  for (const ImuSample& sample : imu) {
    timely.push(sample);
    if (const std::optional<InsStep> step = timely.step()) {
      last_timely = step->state;
      if ((step->start - kStart) / kPeriod % 10 == 5) {
        timely.correct(correctionOf(*step));
      }
    }
  }
  InsEngine late = filled(imu);
  std::vector<InsStep> steps = drain(late);
  for (std::uint64_t k = 5; k < 99; k += 10) {
    const InsStep target = k == 5 ? steps[k] : steps[9];
    ASSERT_EQ(target.start, kStart + static_cast<Nanoseconds>(k) * kPeriod);
    ASSERT_TRUE(late.correct(correctionOf(target)));
    steps = drain(late);
  }
  EXPECT_TRUE(sameState(steps.back().state, last_timely));
}

/// Another engine made the steps so far, and stopped being heard: this one continues from the last correction.
TEST(InsEngine, AdoptsTheCorrectionOfAnother) {
  const std::vector<ImuSample> imu = samples(60);
  InsEngine other = filled(imu);
  const Correction correction{7, drain(other)[30].state};
  ASSERT_TRUE(other.correct(correction));
  const std::vector<InsStep> expected = drain(other);
  InsEngine engine(earth(), {});
  for (std::size_t i = 25; i < imu.size(); ++i) {
    engine.push(imu[i]);
  }
  EXPECT_FALSE(engine.step());
  engine.adopt(correction);
  const std::vector<InsStep> steps = drain(engine);
  ASSERT_EQ(steps.size(), expected.size());
  EXPECT_EQ(steps.front().epoch, 7U);
  EXPECT_EQ(steps.back().epoch, 7U);
  EXPECT_EQ(steps.front().start, correction.state.stamp);
  EXPECT_EQ(steps.front().gap_s, 0.0);
  EXPECT_LT((steps.back().state.v_eb_n - expected.back().state.v_eb_n).norm(), 1e-3)
      << "only the coning from the interval before the first is missing";
}

TEST(InsEngine, TheTimeBetweenAnAdoptedCorrectionAndTheFirstSampleIsAGap) {
  const std::vector<ImuSample> imu = samples(40);
  InsEngine engine(earth(), {});
  for (std::size_t i = 30; i < imu.size(); ++i) {
    engine.push(imu[i]);
  }
  engine.adopt({3, stateAt(imu[20].stamp)});
  const InsStep step = engine.step().value();
  EXPECT_EQ(step.epoch, 3U);
  EXPECT_EQ(step.state.stamp, imu[31].stamp);
  EXPECT_NEAR(step.gap_s, toSeconds(10 * kPeriod), 1e-9);
}

TEST(InsEngine, CorrectionsOfStepsThatAreNotThereAreRefused) {
  const std::vector<ImuSample> imu = samples(50);
  InsEngine engine = filled(imu);
  const std::vector<InsStep> steps = drain(engine);
  EXPECT_FALSE(engine.correct({1, stateAt(imu.back().stamp + kPeriod)}));  // not mechanized yet
  EXPECT_FALSE(engine.correct({1, stateAt(imu[30].stamp + 1)}));           // between two steps
  EXPECT_TRUE(engine.correct({1, steps[30].state}));
  drain(engine);
  EXPECT_FALSE(engine.correct({2, steps[29].state}));  // given up by the one before
  EXPECT_FALSE(InsEngine(earth(), {}).correct({1, stateAt(0)}));
}

TEST(InsEngine, KeepsWhatComesBeforeTheInitialState) {
  const int count = 20000;  // far more than a ring begins with
  const std::vector<ImuSample> imu = samples(count);
  InsEngine engine(earth(), {});
  for (const ImuSample& sample : imu) {
    ASSERT_TRUE(isAccepted(engine.push(sample)));
  }
  engine.initialize(stateAt(imu[10].stamp));
  const std::vector<InsStep> steps = drain(engine);
  ASSERT_EQ(steps.size(), static_cast<std::size_t>(count - 11));
  EXPECT_EQ(steps.front().start, imu[10].stamp);
  EXPECT_EQ(steps.back().state.stamp, imu.back().stamp);
}

TEST(InsEngine, VerdictsAreThoseOfTheScreen) {
  const std::vector<ImuSample> imu = samples(60);
  InsEngine engine = filled(imu);
  ImuSample bad = imu.back();
  EXPECT_EQ(engine.push(bad), ImuVerdict::kNotNewer);
  bad.stamp += kPeriod;
  bad.f_ib_b.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(engine.push(bad), ImuVerdict::kNotFinite);
  bad.f_ib_b.x() = 1e9;
  EXPECT_EQ(engine.push(bad), ImuVerdict::kOutOfRange);
  EXPECT_EQ(engine.newestStamp(), imu.back().stamp);
  EXPECT_EQ(drain(engine).size(), 59U);
}

/// What lies between an initial state and samples that begin later is a gap like any other.
TEST(InsEngine, StartsLongBeforeTheSamples) {
  const std::vector<ImuSample> imu = samples(5);
  InsEngine engine(earth(), {});
  for (const ImuSample& sample : imu) {
    engine.push(sample);
  }
  engine.initialize(stateAt(kStart - 20 * kPeriod));
  const std::vector<InsStep> steps = drain(engine);
  ASSERT_EQ(steps.size(), 4U);
  EXPECT_EQ(steps[0].state.stamp, imu[1].stamp);
  EXPECT_NEAR(steps[0].gap_s, 20.0 * toSeconds(kPeriod), 1e-9);
  EXPECT_EQ(steps[1].gap_s, 0.0);
}

/// Across a gap the samples at its two ends are all that is known.
TEST(InsEngine, BridgesAGapByTheMeanOfItsEnds) {
  const std::vector<ImuSample> imu = samples(60);
  InsEngine engine = filled(imu);
  drain(engine);
  ImuSample after = imu.back();
  after.stamp += 10 * kPeriod;
  after.omega_ib_b = Vector3(0.4, 0.0, 0.0);
  EXPECT_EQ(engine.push(after), ImuVerdict::kAfterGap);
  const InsStep step = engine.step().value();
  EXPECT_NEAR(step.gap_s, 9.0 * toSeconds(kPeriod), 1e-9);
  EXPECT_EQ(step.omega_ib_b, 0.5 * (imu.back().omega_ib_b + after.omega_ib_b));
  EXPECT_EQ(step.f_ib_b, 0.5 * (imu.back().f_ib_b + after.f_ib_b));
  EXPECT_EQ(step.state.stamp, after.stamp);
}

/// Rates before a gap, taken for those at its beginning, would be extrapolated through all of it.
TEST(InsEngine, KeepsTheSpeedThroughALongGap) {
  std::vector<ImuSample> imu = samples(60);
  imu.back().omega_ib_b = Vector3(0.2, -0.1, 0.05);
  InsEngine engine = filled(imu);
  const NavigationState before = drain(engine).back().state;
  ImuSample after = imu.back();
  after.stamp += 30 * kSecond;
  EXPECT_EQ(engine.push(after), ImuVerdict::kAfterGap);
  const NavigationState state = engine.step()->state;
  EXPECT_NEAR(state.v_eb_n.norm(), before.v_eb_n.norm(), 0.05);
}

TEST(InsEngine, InstantaneousSamplesAreAveraged) {
  ImuInputParams params;
  params.sampling = "instantaneous";
  InsEngine engine(earth(), params);
  const std::vector<ImuSample> imu = samples(2);
  engine.initialize(stateAt(kStart));
  engine.push(imu[0]);
  engine.push(imu[1]);
  const InsStep step = engine.step().value();
  EXPECT_EQ(step.f_ib_b, 0.5 * (imu[0].f_ib_b + imu[1].f_ib_b));
  EXPECT_EQ(step.omega_ib_b, 0.5 * (imu[0].omega_ib_b + imu[1].omega_ib_b));
}

TEST(InsEngine, ForgetsEverythingWhenTheSourceHasRestarted) {
  InsEngine engine = filled(samples(10));
  const Nanoseconds before = kStart - 5 * kRestartBackstep;
  EXPECT_EQ(engine.push({before, -9.8 * Vector3::UnitZ(), Vector3::Zero()}), ImuVerdict::kTimeWentBack);
  EXPECT_FALSE(engine.isInitialized());
  EXPECT_EQ(engine.newestStamp(), before);
  EXPECT_EQ(engine.restarts(), 1U);
  engine.initialize(stateAt(before));
  EXPECT_FALSE(engine.step());
  EXPECT_EQ(engine.push({before + kPeriod, -9.7 * Vector3::UnitZ(), Vector3::Zero()}), ImuVerdict::kAccepted);
  EXPECT_EQ(engine.step().value().start, before);
}

/// Memory does not grow with the drive: the oldest steps, which no correction can reach any more, go.
TEST(InsEngine, KeepsTheNewestStepsOnly) {
  const std::vector<ImuSample> imu = samples(20000);
  InsEngine engine(earth(), {});
  engine.initialize(stateAt(imu.front().stamp));
  std::vector<InsStep> steps;
  for (const ImuSample& sample : imu) {
    engine.push(sample);
    for (const InsStep& step : drain(engine)) {
      steps.push_back(step);
    }
  }
  ASSERT_EQ(steps.size(), imu.size() - 1);
  EXPECT_FALSE(engine.correct({1, steps[steps.size() - 4098].state}));
  EXPECT_TRUE(engine.correct({1, steps[steps.size() - 4097].state}));
  EXPECT_TRUE(sameState(drain(engine).back().state, steps.back().state));
}

}  // namespace
}  // namespace slipnav::test
