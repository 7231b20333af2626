/// The parts that keep nodelets in step with each other.

#include <gtest/gtest.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <functional>
#include <optional>
#include <vector>

#include "core/navigation/mechanization_limit.h"
#include "core/navigation/settled_stamp.h"
#include "core/navigation/wheel_backlog.h"
#include "core/ordering/following_sequence.h"
#include "ros/messages/internal_messages.h"
#include "ros/runtime/parameters.h"

namespace slipnav {
namespace {

TEST(SettledStamp, FollowsByThePatience) {
  SettledStamp trusted;
  trusted.push(10 * kSecond, 1.0);
  trusted.push(11 * kSecond, 1.5);
  EXPECT_EQ(trusted.at(1.0), 0);
  EXPECT_EQ(trusted.at(1.25), 10 * kSecond);
  EXPECT_EQ(trusted.at(1.75), 11 * kSecond);
}

TEST(SettledStamp, BeginsAnewWhenTheClockGoesBack) {
  SettledStamp trusted;
  trusted.push(10 * kSecond, 1.0);
  EXPECT_EQ(trusted.at(2.0), 10 * kSecond);
  trusted.push(1 * kSecond, 2.0);
  EXPECT_EQ(trusted.at(2.0), 0);
}

TEST(MechanizationLimit, GoesToTheNextKnownWheelSampleOnly) {
  MechanizationLimit ahead(1.0);
  ahead.restart(10 * kSecond);
  ahead.addWheels(11 * kSecond);
  ahead.addWheels(12 * kSecond);
  EXPECT_EQ(ahead.runUntil(), 11 * kSecond);
  ahead.addStep(11 * kSecond);
  ahead.processed(11 * kSecond);
  EXPECT_EQ(ahead.runUntil(), 12 * kSecond);
}

TEST(MechanizationLimit, GoesFarEnoughToTellThatWheelsAreSilent) {
  MechanizationLimit ahead(1.0);
  ahead.restart(10 * kSecond);
  EXPECT_GT(ahead.runUntil(), 11 * kSecond);
  // A wheel sample is known, but the step that holds it is not yet certain: more steps are needed to tell.
  ahead.addWheels(10 * kSecond + 5);
  ahead.told(ahead.runUntil());
  EXPECT_FALSE(ahead.isStalled());
  ahead.addStep(10 * kSecond + 20);
  EXPECT_TRUE(ahead.isStalled());
  EXPECT_GT(ahead.runUntil(), 11 * kSecond);
}

TEST(MechanizationLimit, GoesBeyondAStepThatIsLongerThanItsWindow) {
  MechanizationLimit ahead(1.0);
  ahead.restart(10 * kSecond);
  ahead.told(ahead.runUntil());
  ahead.addStep(20 * kSecond);
  EXPECT_TRUE(ahead.isStalled());
  EXPECT_GT(ahead.runUntil(), 21 * kSecond);
  ahead.processed(20 * kSecond);
  ahead.addStep(20 * kSecond);  // comes again
  EXPECT_EQ(ahead.runUntil(), 22 * kSecond);
}

WheelMotion wheelsAt(Nanoseconds stamp) {
  WheelMotion wheels;
  wheels.stamp = stamp;
  return wheels;
}

/// Sessions, and how many samples they have passed on.
struct Sessions {
  void push(Nanoseconds stamp) { sessions.push(wheelsAt(stamp), count); }
  void startNext() { sessions.startNext(count); }

  WheelBacklog sessions;
  int passed = 0;
  std::function<void(const WheelMotion&)> count = [this](const WheelMotion&) { ++passed; };
};

TEST(WheelBacklog, KeepsSamplesUntilTheInitialStateComes) {
  Sessions sessions;
  sessions.push(10 * kSecond);
  EXPECT_EQ(sessions.passed, 0);
  sessions.startNext();
  EXPECT_EQ(sessions.passed, 1);
  sessions.push(11 * kSecond);
  EXPECT_EQ(sessions.passed, 2);
}

TEST(WheelBacklog, AfterARestartSamplesWaitForTheNextInitialState) {
  Sessions sessions;
  sessions.startNext();
  sessions.push(100 * kSecond);
  sessions.push(1 * kSecond);
  sessions.push(2 * kSecond);
  EXPECT_EQ(sessions.passed, 1);
  sessions.startNext();
  EXPECT_EQ(sessions.passed, 3);
}

TEST(WheelBacklog, LateSamplesOfTheSessionBeforeAreLeftOut) {
  Sessions sessions;
  sessions.startNext();
  sessions.push(100 * kSecond);
  sessions.startNext();  // the clock of the others went back already
  sessions.push(101 * kSecond);
  EXPECT_EQ(sessions.passed, 1);
  sessions.push(1 * kSecond);
  EXPECT_EQ(sessions.passed, 2);
}

/// Wheels on their way, and the stamps of those that got through since the last look.
struct Wheels {
  std::vector<Nanoseconds> push(Nanoseconds stamp) {
    passed.clear();
    sequence.push(wheelsAt(stamp), note);
    return passed;
  }

  FollowingSequence<WheelMotion> sequence;
  std::vector<Nanoseconds> passed;
  std::function<void(const WheelMotion&)> note = [this](const WheelMotion& wheels) { passed.push_back(wheels.stamp); };
};

using Stamps = std::vector<Nanoseconds>;

TEST(FollowingSequence, WaitsForTheStepOfTheClockToBeTold) {
  Wheels wheels;
  wheels.push(50 * kSecond);
  wheels.push(100 * kSecond - 1);  // a wrong stamp, or a gap
  EXPECT_EQ(wheels.push(100 * kSecond), (Stamps{100 * kSecond - 1, 100 * kSecond}));
  EXPECT_EQ(wheels.push(95 * kSecond), Stamps{});  // a wrong stamp, or a step
  EXPECT_EQ(wheels.push(95 * kSecond + 1), Stamps{});
  wheels.passed.clear();
  const ContinuousTime time({{100 * kSecond + 1, 5 * kSecond + 1}});
  EXPECT_TRUE(wheels.sequence.learn(time, wheels.note));
  EXPECT_EQ(wheels.passed, (Stamps{100 * kSecond + 1, 100 * kSecond + 2}));
  EXPECT_FALSE(wheels.sequence.learn(time, wheels.note));
  EXPECT_EQ(wheels.push(95 * kSecond + 2), Stamps{100 * kSecond + 3});
  wheels.push(3 * kSecond);
  EXPECT_EQ(wheels.push(3 * kSecond + 1), (Stamps{3 * kSecond, 3 * kSecond + 1}));  // a clock that has restarted
}

TEST(FollowingSequence, DoesNotWaitForAMechanizationThatHasForgottenIt) {
  Wheels wheels;
  for (const Nanoseconds stamp : {50 * kSecond, 100 * kSecond - 1, 100 * kSecond, 95 * kSecond}) {
    wheels.push(stamp);
  }
  EXPECT_EQ(wheels.push(95 * kSecond + 1), Stamps{});
  wheels.sequence.recount();
  EXPECT_EQ(wheels.push(95 * kSecond + 2), Stamps{95 * kSecond + 2});
}

TEST(FollowingSequence, DropsASingleWrongStamp) {
  Wheels wheels;
  wheels.push(100 * kSecond);
  wheels.push(200 * kSecond);
  EXPECT_EQ(wheels.push(100 * kSecond + 1), Stamps{100 * kSecond + 1});
  EXPECT_EQ(wheels.sequence.leftOut(), 1U);
}

TEST(InternalMessages, StepsOfTheClockAreKept) {
  InsSteps message;
  fill(ContinuousTime({{1'600'000'000'123'456'789, 5 * kSecond + 1}}), message);
  const ContinuousTime time = timeOf(message);
  ASSERT_EQ(time.steps().size(), 1U);
  EXPECT_EQ(time.steps().front().begin, 1'600'000'000'123'456'789);
  EXPECT_EQ(time.steps().front().offset, 5 * kSecond + 1);
}

NavigationState someState() {
  NavigationState state;
  state.stamp = 1'600'000'000'123'456'789;
  state.q_b_to_n = Quaternion(0.1, 0.2, 0.3, 0.4);
  state.v_eb_n = {1.0, 2.0, 3.0};
  state.position = {0.1, 0.2, 300.0};
  state.accel_bias_b = {4.0, 5.0, 6.0};
  state.gyro_bias_b = {7.0, 8.0, 9.0};
  return state;
}

void expectEqual(const NavigationState& a, const NavigationState& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.q_b_to_n.coeffs(), b.q_b_to_n.coeffs());
  EXPECT_EQ(a.v_eb_n, b.v_eb_n);
  EXPECT_EQ(a.position.latitude_rad, b.position.latitude_rad);
  EXPECT_EQ(a.position.longitude_rad, b.position.longitude_rad);
  EXPECT_EQ(a.position.height_m, b.position.height_m);
  EXPECT_EQ(a.accel_bias_b, b.accel_bias_b);
  EXPECT_EQ(a.gyro_bias_b, b.gyro_bias_b);
}

TEST(InternalMessages, StepsSurvive) {
  const InsStep step{7, 1'599'999'999'000'000'001, someState(), {1.5, 2.5, 3.5}, {4.5, 5.5, 6.5}, 0.25};
  const InsStep back = fromMessage(toMessage(step), step.epoch);
  EXPECT_EQ(back.epoch, step.epoch);
  EXPECT_EQ(back.start, step.start);
  expectEqual(back.state, step.state);
  EXPECT_EQ(back.f_ib_b, step.f_ib_b);
  EXPECT_EQ(back.omega_ib_b, step.omega_ib_b);
  EXPECT_EQ(back.gap_s, step.gap_s);
}

TEST(InternalMessages, StartsSurvive) {
  Start start{3, 2, InitialState()};
  InitialState& initial = *start.state;
  initial.nav = someState();
  initial.vehicle = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  for (int i = 0; i < kErrorStates * kErrorStates; ++i) {
    initial.P(i / kErrorStates, i % kErrorStates) = i;
  }
  initial.origin = {0.7, 0.8, 9.0};
  initial.standstill_variance = 1.25;
  StartState message;
  fill(start, message);
  const Start received = fromMessage(message);
  EXPECT_EQ(received.number, 3U);
  EXPECT_EQ(received.session, 2U);
  ASSERT_TRUE(received.state.has_value());
  const InitialState& back = *received.state;
  expectEqual(back.nav, initial.nav);
  EXPECT_EQ(back.vehicle.wheel_scale, 0.1);
  EXPECT_EQ(back.vehicle.slow_slip, 0.2);
  EXPECT_EQ(back.vehicle.fast_slip, 0.3);
  EXPECT_EQ(back.vehicle.side_slip, 0.4);
  EXPECT_EQ(back.vehicle.mount_pitch_rad, 0.5);
  EXPECT_EQ(back.vehicle.mount_yaw_rad, 0.6);
  EXPECT_EQ(back.P, initial.P);
  EXPECT_EQ(back.origin.latitude_rad, 0.7);
  EXPECT_EQ(back.origin.longitude_rad, 0.8);
  EXPECT_EQ(back.origin.height_m, 9.0);
  EXPECT_EQ(back.standstill_variance, 1.25);
}

TEST(InternalMessages, AnEndSurvives) {
  StartState message;
  fill(Start{3, 2, std::nullopt}, message);
  const Start back = fromMessage(message);
  EXPECT_EQ(back.number, 3U);
  EXPECT_EQ(back.session, 2U);
  EXPECT_FALSE(back.state.has_value());
}

TEST(InternalMessages, RepliesSurvive) {
  FilterCorrection message;
  fill(Reply{5, Correction{7, someState()}, 1'600'000'001'000'000'001}, message);
  const Reply back = fromMessage(message);
  EXPECT_EQ(back.start, 5U);
  EXPECT_EQ(back.run_until, 1'600'000'001'000'000'001);
  ASSERT_TRUE(back.correction.has_value());
  EXPECT_EQ(back.correction->epoch, 7U);
  expectEqual(back.correction->state, someState());

  FilterCorrection without;
  fill(Reply{5, std::nullopt, 1}, without);
  EXPECT_FALSE(fromMessage(without).correction.has_value());
}

TEST(Parameters, TopicsThatRosSplitAtTheirSlashesComeTogetherAgain) {
  XmlRpc::XmlRpcValue tree;
  tree["topics"]["imu"]["data"] = "imu_filtered";
  tree["topics"]["joint_states"] = "/wheels";
  tree["filter"]["gate_alpha"] = 1e-9;
  tree["filter"]["updates"][0] = "wheel";
  tree["simulator"]["seed"] = 3;
  const YAML::Node node = toYamlNode(tree);
  EXPECT_EQ(node["topics"]["imu/data"].as<std::string>(), "imu_filtered");
  EXPECT_EQ(node["topics"]["joint_states"].as<std::string>(), "/wheels");
  EXPECT_EQ(node["filter"]["gate_alpha"].as<double>(), 1e-9);
  EXPECT_EQ(node["filter"]["updates"][0].as<std::string>(), "wheel");
  EXPECT_EQ(node["simulator"]["seed"].as<int>(), 3);
}

}  // namespace
}  // namespace slipnav
