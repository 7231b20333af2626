/// The parts that keep nodelets in step with each other.

#include <gtest/gtest.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <vector>

#include "core/navigation/continuous_wheels.h"
#include "core/navigation/look_ahead.h"
#include "core/navigation/patience.h"
#include "core/navigation/wheel_sessions.h"
#include "ros/messages/internal_messages.h"
#include "ros/runtime/parameters.h"

namespace slipnav {
namespace {

InsStep stepTo(Nanoseconds end) {
  InsStep step;
  step.state.stamp = end;
  return step;
}

std::vector<Nanoseconds> released(StepGate& gate, Nanoseconds newest_wheels, double now_s) {
  std::vector<Nanoseconds> ends;
  gate.release(newest_wheels, now_s, [&ends](const InsStep& step) { ends.push_back(step.state.stamp); });
  return ends;
}

TEST(StepGate, LetsStepsGoThatNoSilenceCanDecide) {
  StepGate gate(1.0);
  gate.push(stepTo(10 * kSecond), 0.0);
  gate.push(stepTo(11 * kSecond), 0.0);
  EXPECT_EQ(released(gate, 9 * kSecond + 1, 0.0), std::vector<Nanoseconds>{10 * kSecond});
  EXPECT_EQ(released(gate, 10 * kSecond + 1, 0.0), std::vector<Nanoseconds>{11 * kSecond});
}

TEST(StepGate, LetsStepsGoAfterTheSilenceHasLasted) {
  StepGate gate(1.0);
  gate.push(stepTo(10 * kSecond), 5.0);
  EXPECT_TRUE(released(gate, 0, 5.0 + 0.9 * kPatience_s).empty());
  EXPECT_EQ(released(gate, 0, 5.0 + 1.1 * kPatience_s).size(), 1U);
}

TEST(StepGate, StepsThatComeAgainNeedNotWaitAgain) {
  StepGate gate(1.0);
  gate.push(stepTo(10 * kSecond), 5.0);
  gate.clear();
  gate.push(stepTo(10 * kSecond), 5.0 + 1.1 * kPatience_s);
  EXPECT_EQ(released(gate, 0, 5.0 + 1.1 * kPatience_s).size(), 1U);
  gate.restart();
  gate.push(stepTo(10 * kSecond), 6.0);
  EXPECT_TRUE(released(gate, 0, 6.0).empty());
}

TEST(StepGate, HoldsNothingWhereWheelsAreNotUsed) {
  StepGate gate(std::nullopt);
  gate.push(stepTo(10 * kSecond), 0.0);
  EXPECT_EQ(released(gate, 0, 0.0).size(), 1U);
}

TEST(TrustedStamp, FollowsByThePatience) {
  TrustedStamp trusted;
  trusted.push(10 * kSecond, 1.0);
  trusted.push(11 * kSecond, 1.5);
  EXPECT_EQ(trusted.at(1.0), 0);
  EXPECT_EQ(trusted.at(1.25), 10 * kSecond);
  EXPECT_EQ(trusted.at(1.75), 11 * kSecond);
}

TEST(StepGate, IsAsPatientAfterARestartAsBefore) {
  StepGate gate(1.0, kSimulatedPatience_s);
  gate.restart();
  gate.push(stepTo(10 * kSecond), 5.0);
  EXPECT_TRUE(released(gate, 0, 5.0 + 0.9 * kSimulatedPatience_s).empty());
  EXPECT_EQ(released(gate, 0, 5.0 + 1.1 * kSimulatedPatience_s).size(), 1U);
}

TEST(TrustedStamp, BeginsAnewWhenTheClockGoesBack) {
  TrustedStamp trusted;
  trusted.push(10 * kSecond, 1.0);
  EXPECT_EQ(trusted.at(2.0), 10 * kSecond);
  trusted.push(1 * kSecond, 2.0);
  EXPECT_EQ(trusted.at(2.0), 0);
}

TEST(LookAhead, GoesToTheNextKnownWheelSampleOnly) {
  LookAhead ahead(1.0);
  ahead.restart(10 * kSecond);
  ahead.addWheels(11 * kSecond);
  ahead.addWheels(12 * kSecond);
  EXPECT_EQ(ahead.runUntil(), 11 * kSecond);
  ahead.addStep(11 * kSecond);
  ahead.processed(11 * kSecond);
  EXPECT_EQ(ahead.runUntil(), 12 * kSecond);
}

TEST(LookAhead, GoesFarEnoughToTellThatWheelsAreSilent) {
  LookAhead ahead(1.0);
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

TEST(LookAhead, GoesBeyondAStepThatIsLongerThanItsWindow) {
  LookAhead ahead(1.0);
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

TEST(WheelSessions, KeepsSamplesUntilTheInitialStateComes) {
  WheelSessions sessions;
  EXPECT_TRUE(sessions.push(wheelsAt(10 * kSecond)).empty());
  EXPECT_EQ(sessions.startNext().size(), 1U);
  EXPECT_EQ(sessions.push(wheelsAt(11 * kSecond)).size(), 1U);
}

TEST(WheelSessions, AfterARestartSamplesWaitForTheNextInitialState) {
  WheelSessions sessions;
  sessions.startNext();
  sessions.push(wheelsAt(100 * kSecond));
  EXPECT_TRUE(sessions.push(wheelsAt(1 * kSecond)).empty());
  EXPECT_TRUE(sessions.push(wheelsAt(2 * kSecond)).empty());
  EXPECT_EQ(sessions.startNext().size(), 2U);
}

TEST(WheelSessions, LateSamplesOfTheSessionBeforeAreLeftOut) {
  WheelSessions sessions;
  sessions.startNext();
  sessions.push(wheelsAt(100 * kSecond));
  EXPECT_TRUE(sessions.startNext().empty());  // the clock of the others went back already
  EXPECT_TRUE(sessions.push(wheelsAt(101 * kSecond)).empty());
  EXPECT_EQ(sessions.push(wheelsAt(1 * kSecond)).size(), 1U);
}

TEST(ContinuousWheels, WaitForTheStepOfTheClockToBeTold) {
  ContinuousWheels wheels;
  wheels.push(wheelsAt(50 * kSecond));
  EXPECT_EQ(wheels.push(wheelsAt(100 * kSecond)).size(), 1U);
  EXPECT_TRUE(wheels.push(wheelsAt(95 * kSecond)).empty());
  const std::vector<WheelMotion> known = wheels.learn(ContinuousTime({{100 * kSecond + 1, 5 * kSecond + 1}}));
  ASSERT_EQ(known.size(), 1U);
  EXPECT_EQ(known.front().stamp, 100 * kSecond + 1);
  EXPECT_EQ(wheels.push(wheelsAt(96 * kSecond)).front().stamp, 101 * kSecond + 1);
  EXPECT_EQ(wheels.push(wheelsAt(3 * kSecond)).front().stamp, 3 * kSecond);  // a clock that has restarted
}

TEST(ContinuousWheels, DoNotWaitForAMechanisationThatHasForgottenIt) {
  ContinuousWheels wheels;
  wheels.push(wheelsAt(50 * kSecond));
  wheels.push(wheelsAt(100 * kSecond));
  wheels.push(wheelsAt(95 * kSecond));
  wheels.recount();
  EXPECT_EQ(wheels.push(wheelsAt(96 * kSecond)).size(), 1U);
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
  const InsStep step{42, 7, 1'599'999'999'000'000'001, someState(), {1.5, 2.5, 3.5}, {4.5, 5.5, 6.5}, 0.25};
  const InsStep back = fromMessage(toMessage(step), step.epoch);
  EXPECT_EQ(back.sequence, step.sequence);
  EXPECT_EQ(back.epoch, step.epoch);
  EXPECT_EQ(back.start, step.start);
  expectEqual(back.state, step.state);
  EXPECT_EQ(back.f_ib_b, step.f_ib_b);
  EXPECT_EQ(back.omega_ib_b, step.omega_ib_b);
  EXPECT_EQ(back.gap_s, step.gap_s);
}

TEST(InternalMessages, InitialStatesSurvive) {
  InitialState initial;
  initial.nav = someState();
  initial.vehicle = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  for (int i = 0; i < kErrorStates * kErrorStates; ++i) {
    initial.P(i / kErrorStates, i % kErrorStates) = i;
  }
  initial.origin = {0.7, 0.8, 9.0};
  initial.tremor_variance = 1.25;
  StartState message;
  fill(initial, message);
  const InitialState back = fromMessage(message);
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
  EXPECT_EQ(back.tremor_variance, 1.25);
}

TEST(InternalMessages, CorrectionsSurvive) {
  FilterCorrection message;
  fill(Correction{42, 7, someState()}, message);
  EXPECT_TRUE(message.corrects);
  const Correction back = fromMessage(message);
  EXPECT_EQ(back.sequence, 42U);
  EXPECT_EQ(back.epoch, 7U);
  expectEqual(back.state, someState());
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
