/// The operator's panel: what it shows in every state, and what every button does, by synthetic clicks.
///
/// With SLIPNAV_PICTURES in the environment, pictures of all states are left in that folder.

#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/spinner.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <QApplication>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QMouseEvent>
#include <QPalette>
#include <QPushButton>

#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "panel/stop_panel.h"

namespace slipnav {
namespace {

constexpr double kPatience_s = 10.0;

/// The services that the nodelets have, and what they were asked. They answer side by side, like nodelets.
class FakeNodelets {
 public:
  FakeNodelets() {
    node_.setCallbackQueue(&queue_);
    for (const char* name : {"stop_supervisor/stop_now", "initializer/initialize", "filter/save_checkpoint"}) {
      serve<std_srvs::Trigger>(name, [](const auto&) { return std::string("called"); });
    }
    for (const char* name : {"stop_supervisor/override", "stop_supervisor/emergency_stop"}) {
      serve<std_srvs::SetBool>(name, [](const auto& request) { return std::string(request.data ? "true" : "false"); });
    }
    for (const char* name : {"stop_supervisor/set_parameters", "forecast/set_parameters"}) {
      const boost::function<bool(dynamic_reconfigure::ReconfigureRequest&, dynamic_reconfigure::ReconfigureResponse&)>
          callback = [this, name](auto& request, auto& response) {
            response.config = request.config;
            note(std::string(name) + (request.config.strs.empty()
                                          ? " " + std::to_string(request.config.doubles[0].value)
                                          : " " + request.config.strs[0].value));
            return true;
          };
      servers_.push_back(node_.advertiseService(name, callback));
    }
    spinner_.start();
  }

  /// Until then the checkpoint is not answered for.
  std::unique_lock<std::mutex> holdUpCheckpoints() { return std::unique_lock<std::mutex>(checkpoint_); }

  std::vector<std::string> calls() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return calls_;
  }

 private:
  template <class Service, class Say>
  void serve(const std::string& name, Say say) {
    const boost::function<bool(typename Service::Request&, typename Service::Response&)> callback =
        [this, name, say](auto& request, auto& response) {
          note(name + " " + say(request));
          if (name == "filter/save_checkpoint") {
            const std::lock_guard<std::mutex> until_it_may(checkpoint_);
          }
          response.success = 1;
          return true;
        };
    servers_.push_back(node_.advertiseService(name, callback));
  }

  void note(const std::string& call) {
    const std::lock_guard<std::mutex> lock(mutex_);
    calls_.push_back(call);
  }

  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  std::vector<ros::ServiceServer> servers_;
  std::mutex mutex_;
  std::mutex checkpoint_;
  std::vector<std::string> calls_;
  ros::AsyncSpinner spinner_{2, &queue_};
};

class RvizPanel : public ::testing::Test {
 protected:
  RvizPanel() {
    panel_.resize(380, 620);
    panel_.show();
  }

  bool waitUntil(const std::function<bool()>& condition) {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    while (!condition() && (ros::SteadyTime::now() - begin).toSec() < kPatience_s) {
      say();
      ros::spinOnce();
      QApplication::processEvents(QEventLoop::AllEvents, 20);
    }
    return condition();
  }

  /// What the nodelets publish, again and again.
  void say() {
    if (!silent_) {
      stops_.publish(stop_);
      forecasts_.publish(forecast_);
      slips_.publish(slip_);
    }
  }

  QString text(const char* name) const { return panel_.findChild<QLabel*>(name)->text(); }
  QPushButton* button(const char* name) const { return panel_.findChild<QPushButton*>(name); }

  static void click(QWidget* widget) {
    const QPointF middle(widget->width() / 2.0, widget->height() / 2.0);
    for (const QEvent::Type type : {QEvent::MouseButtonPress, QEvent::MouseButtonRelease}) {
      QMouseEvent event(type, middle, widget->mapToGlobal(middle.toPoint()), Qt::LeftButton,
                        type == QEvent::MouseButtonPress ? Qt::LeftButton : Qt::NoButton, Qt::NoModifier);
      QApplication::sendEvent(widget, &event);
    }
  }

  void expectCall(const std::string& call) {
    EXPECT_TRUE(waitUntil([&] {
      const std::vector<std::string> calls = nodelets_.calls();
      return !calls.empty() && calls.back() == call;
    })) << call;
  }

  void expectState(const char* state, const char* picture) {
    EXPECT_TRUE(waitUntil([&] { return text("state") == state; })) << state << " " << text("state").toStdString();
    if (const char* folder = std::getenv("SLIPNAV_PICTURES")) {
      panel_.grab().save(QString("%1/panel_%2.png").arg(folder, picture));
      const QPalette light = QApplication::palette();
      QApplication::setPalette(darkPalette());
      QApplication::processEvents();
      panel_.grab().save(QString("%1/panel_%2_dark.png").arg(folder, picture));
      QApplication::setPalette(light);
    }
  }

  static QPalette darkPalette() {
    QPalette palette;
    for (const QPalette::ColorRole role : {QPalette::Window, QPalette::Button, QPalette::ToolTipBase}) {
      palette.setColor(role, QColor(53, 53, 53));
    }
    for (const QPalette::ColorRole role :
         {QPalette::WindowText, QPalette::Text, QPalette::ButtonText, QPalette::ToolTipText}) {
      palette.setColor(role, Qt::white);
      palette.setColor(QPalette::Disabled, role, QColor(127, 127, 127));
    }
    palette.setColor(QPalette::Base, QColor(35, 35, 35));
    return palette;
  }

  FakeNodelets nodelets_;
  ros::NodeHandle node_;
  ros::Publisher stops_ = node_.advertise<StopStatus>("stop", 10);
  ros::Publisher forecasts_ = node_.advertise<ErrorForecast>("error_forecast", 10);
  ros::Publisher slips_ = node_.advertise<Slip>("slip", 10);
  ros::Publisher starts_ = node_.advertise<Initialization>("initialization", 10, true);
  ros::Publisher diagnostics_ = node_.advertise<diagnostic_msgs::DiagnosticArray>("diagnostics", 10);
  StopPanel panel_;
  StopStatus stop_ = makeStop();
  ErrorForecast forecast_ = makeForecast();
  Slip slip_ = makeSlip();
  bool silent_ = false;

 private:
  static StopStatus makeStop() {
    StopStatus stop;
    stop.mode = StopStatus::MODE_ACTIVE;
    stop.time_left_s = 34.0;
    stop.reason = "the position error reaches its threshold";
    return stop;
  }
  static ErrorForecast makeForecast() {
    ErrorForecast forecast;
    forecast.times_s = {0.0};
    forecast.horizontal_bound_m = {1.2};
    forecast.threshold_m = 3.0;
    return forecast;
  }
  static Slip makeSlip() {
    Slip slip;
    slip.mean_ratio = 0.08;
    slip.forward_speed_mps = 0.5;
    slip.duration_s = 0.1;
    return slip;
  }
};

TEST_F(RvizPanel, ShowsEveryState) {
  silent_ = true;
  expectState("NO DATA", "stale");
  EXPECT_FALSE(button("stop_now")->isEnabled());
  EXPECT_EQ(panel_.findChild<QComboBox*>("mode")->currentText(), "") << "what nobody has said is not shown";
  EXPECT_EQ(panel_.findChild<QDoubleSpinBox*>("threshold")->text(), "–");
  silent_ = false;
  Initialization start;
  start.progress = "stand still, 3 of 5 s";
  starts_.publish(start);
  expectState("START", "start");
  EXPECT_EQ(text("reason"), "stand still, 3 of 5 s");
  start.done = 1;
  starts_.publish(start);
  expectState("DRIVING", "driving");
  EXPECT_EQ(text("countdown"), "stop in 34 s");
  stop_.state = StopStatus::COUNTING_DOWN;
  stop_.time_left_s = 7.0;
  expectState("STOP AHEAD", "countdown");
  stop_.state = StopStatus::STOPPING;
  expectState("STOPPING", "stopping");
  stop_.state = StopStatus::HOLDING;
  stop_.time_left_s = 2.0;
  expectState("HOLDING", "holding");
  stop_.state = StopStatus::DRIVING;
  stop_.overridden = 1;
  stop_.reason = "overridden by the operator";
  expectState("OVERRIDE", "override");
  EXPECT_EQ(text("countdown"), "");
  stop_.emergency_stop = 1;
  stop_.reason = "emergency stop, but nobody listens to cmd_vel or e_stop";
  diagnostic_msgs::DiagnosticArray array;
  array.status.resize(1);
  array.status[0].name = "stop_supervisor: /stop_supervisor";
  array.status[0].level = diagnostic_msgs::DiagnosticStatus::ERROR;
  array.status[0].message = "emergency stop without effect: nobody listens to cmd_vel or e_stop";
  diagnostics_.publish(array);
  expectState("EMERGENCY STOP", "emergency");
  EXPECT_TRUE(waitUntil([this] { return text("alarms").contains("emergency stop without effect"); }));
  silent_ = true;
  expectState("NO DATA", "silent");
}

TEST_F(RvizPanel, EveryButtonCallsItsService) {
  ASSERT_TRUE(waitUntil([this] { return button("stop_now")->isEnabled() && button("emergency_stop")->isEnabled(); }));
  click(button("stop_now"));
  expectCall("stop_supervisor/stop_now called");
  click(button("override"));
  expectCall("stop_supervisor/override true");
  stop_.overridden = 1;
  ASSERT_TRUE(waitUntil([this] { return text("state") == "OVERRIDE"; }));
  click(button("override"));
  expectCall("stop_supervisor/override false");
  click(button("initialize"));
  expectCall("initializer/initialize called");
  click(button("checkpoint"));
  expectCall("filter/save_checkpoint called");
  auto* mode = panel_.findChild<QComboBox*>("mode");
  Q_EMIT mode->activated(1);
  expectCall("stop_supervisor/set_parameters advise");
  auto* threshold = panel_.findChild<QDoubleSpinBox*>("threshold");
  ASSERT_TRUE(waitUntil([&] { return threshold->value() == 3.0; }));
  threshold->setFocus();
  threshold->setValue(2.0);
  Q_EMIT threshold->editingFinished();
  expectCall("forecast/set_parameters 2.000000");
}

TEST_F(RvizPanel, AnEmergencyStopIsOneClickAndItsEndTwo) {
  ASSERT_TRUE(waitUntil([this] { return button("emergency_stop")->isEnabled(); }));
  click(button("emergency_stop"));
  expectCall("stop_supervisor/emergency_stop true");
  stop_.emergency_stop = 1;
  ASSERT_TRUE(waitUntil([this] { return text("state") == "EMERGENCY STOP"; }));
  const std::size_t before = nodelets_.calls().size();
  click(button("emergency_stop"));
  EXPECT_TRUE(waitUntil([this] { return button("emergency_stop")->text().contains("once more"); }));
  EXPECT_EQ(nodelets_.calls().size(), before) << "one click releases nothing";
  click(button("emergency_stop"));
  expectCall("stop_supervisor/emergency_stop false");
}

TEST_F(RvizPanel, AnEmergencyStopWaitsForNoOtherService) {
  ASSERT_TRUE(waitUntil([this] { return button("checkpoint")->isEnabled() && button("emergency_stop")->isEnabled(); }));
  const std::unique_lock<std::mutex> hang = nodelets_.holdUpCheckpoints();
  click(button("checkpoint"));
  expectCall("filter/save_checkpoint called");
  click(button("emergency_stop"));
  expectCall("stop_supervisor/emergency_stop true");
}

/// Of 800 rows, this many remain after the window frame and rviz's status bar.
TEST_F(RvizPanel, FitsASmallScreenWithAllItsButtons) {
  diagnostic_msgs::DiagnosticArray array;
  array.status.resize(6);
  for (std::size_t i = 0; i < array.status.size(); ++i) {
    array.status[i].name = "manager: /nodelet" + std::to_string(i);
    array.status[i].level = diagnostic_msgs::DiagnosticStatus::WARN;
    array.status[i].message = "a message that is about as long as messages are, or longer";
  }
  diagnostics_.publish(array);
  ASSERT_TRUE(waitUntil([this] { return text("alarms").count('\n') >= 3; }));
  panel_.resize(300, 660);
  QApplication::processEvents();
  EXPECT_LE(panel_.height(), 660);
  for (const char* name : {"stop_now", "override", "initialize", "checkpoint", "emergency_stop"}) {
    const QPoint corner = button(name)->mapTo(&panel_, button(name)->rect().bottomRight());
    EXPECT_TRUE(panel_.rect().contains(corner)) << name << " " << corner.x() << " " << corner.y();
  }
}

TEST_F(RvizPanel, IsReachedByTheKeyboard) {
  for (const char* name : {"emergency_stop", "stop_now", "override", "initialize", "checkpoint"}) {
    EXPECT_NE(button(name)->focusPolicy() & Qt::TabFocus, 0) << name;
    EXPECT_TRUE(button(name)->text().contains('&')) << name;
  }
}

}  // namespace
}  // namespace slipnav

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "rviz_panel");
  const QApplication application(argc, argv);
  const ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
