/// Parameters that are changed while the nodelets run, through dynamic_reconfigure.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <ros/topic.h>
#include <slipnav/ErrorForecast.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "replay_fixture.h"
#include "ros/runtime/tuning_messages.h"

namespace slipnav {
namespace {

constexpr double kRate = 20.0;
const char* const kThreshold = "forecast.threshold_m";
const char* const kGate = "filter.gate_alpha";

/// The value of one parameter in a message; nothing when it is not there.
template <class Value>
std::optional<Value> valueOf(const std::string& key, const dynamic_reconfigure::Config& message) {
  for (const ParameterChange& change : changesOf(message)) {
    if (change.key == key && std::holds_alternative<Value>(change.value)) {
      return std::get<Value>(change.value);
    }
  }
  return std::nullopt;
}

/// What the nodelet answers to a wish.
dynamic_reconfigure::Config tune(const std::string& nodelet, const std::string& key, const ParameterValue& value) {
  dynamic_reconfigure::Reconfigure call;
  call.request.config = toValues({{key, value, {}, {}, ""}});
  EXPECT_TRUE(ros::service::call(nodelet + "/set_parameters", call));
  return call.response.config;
}

template <class Message>
boost::shared_ptr<const Message> latched(const std::string& topic) {
  return ros::topic::waitForMessage<Message>(topic, ros::Duration(0.0));
}

/// The values in the newest diagnostics of a nodelet, by key, a moment from now.
std::map<std::string, std::string> diagnosticsOf(const std::string& name) {
  std::map<std::string, std::string> values;
  const boost::function<void(const diagnostic_msgs::DiagnosticArray::ConstPtr&)> note = [&](const auto& message) {
    for (const diagnostic_msgs::DiagnosticStatus& status : message->status) {
      for (const diagnostic_msgs::KeyValue& item : status.values) {
        if (status.name == name) {
          values[item.key] = item.value;
        }
      }
    }
  };
  const ros::Subscriber listener =
      ros::NodeHandle().subscribe<diagnostic_msgs::DiagnosticArray>("/diagnostics", 9, note);
  for (int i = 0; i < 100 && values.empty(); ++i) {
    ros::WallDuration(0.05).sleep();
    ros::spinOnce();
  }
  return values;
}

class TuningTest : public test::ReplayFixture {
 protected:
  /// Plays the drive; the error forecasts that come of it.
  static std::vector<ErrorForecast> replay() {
    std::vector<ErrorForecast> forecasts;
    const boost::function<void(const ErrorForecast::ConstPtr&)> note = [&](const auto& message) {
      forecasts.push_back(*message);
    };
    const ros::Subscriber listener = ros::NodeHandle().subscribe<ErrorForecast>("error_forecast", 1000, note);
    const BagEvaluation offline = evaluateBag(bag_->path(), *config_, "", {});
    session_->play({bag_->path(), kRate, 0.0, 0.0}, offline.report.estimates.back().stamp);
    for (int i = 0; i < 20; ++i) {
      ros::WallDuration(0.05).sleep();
      ros::spinOnce();
    }
    return forecasts;
  }

  static double soonestStop(const std::vector<ErrorForecast>& forecasts) {
    const auto soonest = std::min_element(forecasts.begin(), forecasts.end(), [](const auto& a, const auto& b) {
      return a.time_to_stop_s < b.time_to_stop_s;
    });
    return soonest == forecasts.end() ? -1.0 : soonest->time_to_stop_s;
  }
};

TEST_F(TuningTest, WhatIsOfferedIsDescribedAsInTheConfiguration) {
  const auto description = latched<dynamic_reconfigure::ConfigDescription>("/forecast/parameter_descriptions");
  EXPECT_EQ(valueOf<double>(kThreshold, description->min), 1e-3);
  EXPECT_EQ(valueOf<double>(kThreshold, description->max), 1e4);
  EXPECT_EQ(valueOf<double>(kThreshold, description->dflt), config_->forecast.threshold_m);
  ASSERT_EQ(description->groups.size(), 2U);
  EXPECT_EQ(description->groups[1].parameters.front().name, kThreshold);
  EXPECT_NE(description->groups[1].parameters.front().description.find("[m]"), std::string::npos);
  const auto values = latched<dynamic_reconfigure::Config>("/forecast/parameter_updates");
  EXPECT_EQ(valueOf<double>(kThreshold, *values), config_->forecast.threshold_m);
}

TEST_F(TuningTest, TheAnswerHoldsTheNewValueAndSoDoesTheTree) {
  EXPECT_EQ(valueOf<double>(kThreshold, tune("/forecast", kThreshold, 1.5)), 1.5);
  EXPECT_EQ(valueOf<double>(kThreshold, *latched<dynamic_reconfigure::Config>("/forecast/parameter_updates")), 1.5);
  EXPECT_EQ(ros::NodeHandle().param("/slipnav/forecast/threshold_m", 0.0), 1.5);
  EXPECT_EQ(diagnosticsOf("forecast: /forecast")["changed while running"], "forecast.threshold_m from 3 to 1.5");
  EXPECT_EQ(valueOf<double>(kThreshold, tune("/forecast", kThreshold, config_->forecast.threshold_m)),
            config_->forecast.threshold_m);
  EXPECT_EQ(diagnosticsOf("forecast: /forecast")["changed while running"], "");
}

TEST_F(TuningTest, WhatCannotBeIsRefusedAndTheAnswerHoldsTheOldValues) {
  const double threshold_m = config_->forecast.threshold_m;
  EXPECT_EQ(valueOf<double>(kThreshold, tune("/forecast", kThreshold, -1.0)), threshold_m) << "out of range";
  EXPECT_EQ(valueOf<double>(kThreshold, tune("/forecast", "forecast.step_s", 0.2)), threshold_m) << "not offered";
  EXPECT_EQ(valueOf<double>(kGate, tune("/filter", kThreshold, 1.0)), config_->filter.gate_alpha) << "not its own";
  EXPECT_EQ(ros::NodeHandle().param("/slipnav/forecast/threshold_m", 0.0), threshold_m);
  const char* const least = "zero_motion.min_velocity_std_mps";
  EXPECT_EQ(valueOf<double>(least, tune("/filter", least, 0.5)), config_->zero_motion.min_velocity_std_mps)
      << "above the largest";
  EXPECT_EQ(valueOf<std::string>("stop.mode", tune("/stop_supervisor", "stop.mode", std::string("go"))), "advise");
}

TEST_F(TuningTest, OfSeveralValuesAllAreRefusedWhenOneIsWrong) {
  dynamic_reconfigure::Reconfigure call;
  call.request.config = toValues({{kThreshold, 1.0, {}, {}, ""}, {"forecast.sigmas", 1000.0, {}, {}, ""}});
  ASSERT_TRUE(ros::service::call("/forecast/set_parameters", call));
  EXPECT_EQ(valueOf<double>(kThreshold, call.response.config), config_->forecast.threshold_m);
}

TEST_F(TuningTest, ToolsOfDynamicReconfigureWork) {
  ASSERT_EQ(std::system("rosrun dynamic_reconfigure dynparam set /forecast forecast.threshold_m 2.5"), 0);
  EXPECT_EQ(ros::NodeHandle().param("/slipnav/forecast/threshold_m", 0.0), 2.5);
  ASSERT_EQ(std::system("rosrun dynamic_reconfigure dynparam get /stop_supervisor"), 0);
  tune("/forecast", kThreshold, config_->forecast.threshold_m);
}

TEST_F(TuningTest, ASmallerThresholdMeansAnEarlierStop) {
  EXPECT_GT(soonestStop(replay()), 10.0);
  tune("/forecast", kThreshold, 0.05);
  const std::vector<ErrorForecast> forecasts = replay();
  ASSERT_FALSE(forecasts.empty());
  EXPECT_EQ(forecasts.front().threshold_m, 0.05);
  EXPECT_LT(soonestStop(forecasts), 5.0);
  tune("/forecast", kThreshold, config_->forecast.threshold_m);
}

TEST_F(TuningTest, ANarrowerGateChangesTheEstimateAndTheOldOneGivesTheOldBits) {
  replay();
  const auto usual = session_->odometry().bytes();
  tune("/filter", kGate, 0.5);
  replay();
  EXPECT_NE(session_->odometry().bytes(), usual);
  tune("/filter", kGate, config_->filter.gate_alpha);
  replayAndCompare(bag_->path(), kRate);
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "tuning");
  return RUN_ALL_TESTS();
}
