#include "panel/stop_panel.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <QVBoxLayout>

#include <pluginlib/class_list_macros.hpp>

#include <boost/function.hpp>
#include <cstdint>

#include "config/topics.h"
#include "panel/bound_chart.h"
#include "panel/operator_services.h"
#include "ros/runtime/internal_topics.h"

namespace slipnav {
namespace {

constexpr int kRefresh_ms = 200;
constexpr double kLook_s = 1.0;
constexpr std::uint32_t kMostWaiting = 100;  // messages while the window is busy
constexpr double kReleaseWindow_s = 3.0;     // between the two clicks that end an emergency stop
constexpr int kMostAlarms = 4;
constexpr double kUnknownThreshold = 0.0;
constexpr int kNoMode = -1;
const char* const kModes[] = {"off", "advise", "active"};  // by the numbers of slipnav/StopStatus

double now() { return ros::SteadyTime::now().toSec(); }

/// Background and text color of the state, visible from afar.
QString styleOf(Mood mood) {
  switch (mood) {
    case Mood::kDanger:
      return "background: #b01818; color: white;";
    case Mood::kStopping:
      return "background: #8a4b00; color: white;";
    case Mood::kAhead:
      return "background: #f0b429; color: black;";
    case Mood::kDriving:
      return "background: #1f6f43; color: white;";
    case Mood::kStart:
      return "background: #1d4e89; color: white;";
    case Mood::kStale:
      break;
  }
  return "background: #666666; color: white;";
}

QLabel* label(QWidget* parent, const char* name) {
  auto* made = new QLabel(parent);
  made->setObjectName(name);
  made->setWordWrap(true);
  made->setTextFormat(Qt::PlainText);
  return made;
}

void scaleFont(QWidget* widget, double factor) {
  QFont font = widget->font();
  font.setPointSizeF(factor * font.pointSizeF());
  font.setBold(true);
  widget->setFont(font);
}

}  // namespace

StopPanel::StopPanel(QWidget* parent)
    : rviz::Panel(parent), services_(std::make_unique<OperatorServices>(node_.getNamespace())) {
  auto* layout = new QVBoxLayout(this);
  setLayout(layout);
  buildWords();
  buildButtons();
  const TopicNames topics;
  listen<StopStatus>(topics.stop);
  listen<ErrorForecast>(topics.error_forecast);
  listen<Slip>(topics.slip);
  listen<Initialization>(kInitializationTopic);
  listen<std_msgs::String>(kFiguresTopic);
  listen<diagnostic_msgs::DiagnosticArray>(topics.diagnostics);
  timer_ = new QTimer(this);
  connect(timer_, &QTimer::timeout, this, [this] { refresh(); });
  timer_->start(kRefresh_ms);
  refresh();
}

StopPanel::~StopPanel() { subscribers_.clear(); }

template <class Message>
void StopPanel::listen(const std::string& topic) {
  const boost::function<void(const boost::shared_ptr<const Message>&)> take =
      [this](const boost::shared_ptr<const Message>& message) { view_.take(*message, now()); };
  subscribers_.push_back(node_.subscribe<Message>(topic, kMostWaiting, take));
}

void StopPanel::buildWords() {
  state_ = label(this, "state");
  state_->setAlignment(Qt::AlignCenter);
  state_->setMargin(6);
  scaleFont(state_, 2.2);
  countdown_ = label(this, "countdown");
  countdown_->setAlignment(Qt::AlignCenter);
  scaleFont(countdown_, 1.5);
  reason_ = label(this, "reason");
  reason_->setAlignment(Qt::AlignCenter);
  chart_ = new BoundChart(this);
  numbers_ = label(this, "numbers");
  alarms_ = label(this, "alarms");
  for (QWidget* widget :
       {static_cast<QWidget*>(state_), static_cast<QWidget*>(countdown_), static_cast<QWidget*>(reason_),
        static_cast<QWidget*>(chart_), static_cast<QWidget*>(numbers_), static_cast<QWidget*>(alarms_)}) {
    layout()->addWidget(widget);
  }
}

QPushButton* StopPanel::button(const char* name, const QString& words, const std::function<void()>& action) {
  auto* made = new QPushButton(words, this);
  made->setObjectName(name);
  connect(made, &QPushButton::clicked, this, [action] { action(); });
  return made;
}

void StopPanel::buildButtons() {
  emergency_ = button("emergency_stop", "", [this] { onEmergencyStop(); });
  emergency_->setMinimumHeight(56);
  scaleFont(emergency_, 1.4);
  stop_now_ = button("stop_now", "&Stop now", [this] { services_->trigger(kStopNowService); });
  override_ = button("override", "&Override", [this] { services_->set(kOverrideService, !shown_.overridden); });
  initialize_ = button("initialize", "&Initialize", [this] { services_->trigger(kInitializeService); });
  checkpoint_ = button("checkpoint", "Save &checkpoint", [this] { services_->trigger(kCheckpointService); });
  mode_ = new QComboBox(this);
  mode_->setObjectName("mode");
  for (const char* mode : kModes) {
    mode_->addItem(mode);
  }
  mode_->setCurrentIndex(kNoMode);  // until it is known
  connect(mode_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int index) { services_->tune(kSupervisorParameters, "stop.mode", std::string(kModes[index])); });
  threshold_ = new QDoubleSpinBox(this);
  threshold_->setObjectName("threshold");
  threshold_->setRange(kUnknownThreshold, 100.0);
  threshold_->setSpecialValueText("–");
  threshold_->setSingleStep(0.5);
  threshold_->setSuffix(" m");
  threshold_->setKeyboardTracking(false);
  connect(threshold_, &QDoubleSpinBox::editingFinished, this, [this] { onThreshold(); });
  answer_ = label(this, "answer");
  auto* grid = new QGridLayout;
  grid->addWidget(stop_now_, 0, 0, 1, 2);
  grid->addWidget(override_, 0, 2, 1, 2);
  grid->addWidget(initialize_, 1, 0, 1, 2);
  grid->addWidget(checkpoint_, 1, 2, 1, 2);
  grid->addWidget(new QLabel("mode", this), 2, 0);
  grid->addWidget(mode_, 2, 1);
  grid->addWidget(new QLabel("stop at", this), 2, 2);
  grid->addWidget(threshold_, 2, 3);
  auto* column = qobject_cast<QVBoxLayout*>(layout());
  column->insertWidget(column->indexOf(chart_), emergency_);  // visible on the smallest screen
  column->addLayout(grid);
  column->addWidget(answer_);
  column->addStretch(1);
}

void StopPanel::onEmergencyStop() {
  if (!shown_.emergency_stop) {
    services_->set(kEmergencyStopService, true);
  } else if (now() - release_armed_s_ <= kReleaseWindow_s) {
    release_armed_s_ = -1e9;
    services_->set(kEmergencyStopService, false);
  } else {
    release_armed_s_ = now();
  }
  refresh();
}

void StopPanel::onThreshold() {
  if (threshold_->value() != kUnknownThreshold && threshold_->value() != shown_.threshold_m) {
    services_->tune(kForecastParameters, "forecast.threshold_m", threshold_->value());
  }
}

void StopPanel::refresh() {
  if (now() - looked_s_ > kLook_s) {
    looked_s_ = now();
    services_->look();
  }
  if (const std::optional<std::string> answer = services_->answer()) {
    answer_->setText(QString::fromStdString(*answer));
  }
  shown_ = view_.picture(now());
  showPicture(shown_);
  showButtons(shown_);
}

void StopPanel::showPicture(const OperatorPicture& picture) {
  state_->setText(QString::fromStdString(picture.state));
  state_->setStyleSheet(styleOf(picture.mood));
  countdown_->setText(QString::fromStdString(picture.countdown));
  reason_->setText(QString::fromStdString(picture.reason));
  const QString slip = picture.slip.empty() ? "–" : QString::fromStdString(picture.slip);
  const QString way = picture.since_stop.empty() ? "–" : QString::fromStdString(picture.since_stop);
  const QString figures = QString::fromStdString(picture.figures);
  numbers_->setText("slip " + slip + "    since the stop " + way + (figures.isEmpty() ? "" : "\n" + figures));
  chart_->display(picture);
  QStringList alarms;
  for (const OperatorAlarm& alarm : picture.alarms) {
    if (alarms.size() < kMostAlarms) {
      alarms.append(QString::fromStdString((alarm.level > 1 ? "✖ " : "⚠ ") + alarm.words));
    }
  }
  alarms_->setText(alarms.join("\n"));
}

void StopPanel::enable(QWidget* widget, const std::string& service, bool needs_data, const OperatorPicture& picture) {
  const bool there = services_->isThere(service);
  const bool stale = needs_data && picture.isStale();
  widget->setEnabled(there && !stale);
  widget->setToolTip(QString::fromStdString(!there ? service + " is not there" : stale ? "no data" : service));
}

void StopPanel::showButtons(const OperatorPicture& picture) {
  enable(emergency_, kEmergencyStopService, false, picture);
  enable(stop_now_, kStopNowService, true, picture);
  enable(override_, kOverrideService, false, picture);
  enable(initialize_, kInitializeService, false, picture);
  enable(checkpoint_, kCheckpointService, false, picture);
  enable(mode_, kSupervisorParameters, true, picture);
  enable(threshold_, kForecastParameters, false, picture);
  const bool armed = now() - release_armed_s_ <= kReleaseWindow_s;
  emergency_->setText(!picture.emergency_stop ? "&EMERGENCY STOP" : armed ? "once more: r&elease" : "r&elease …");
  emergency_->setStyleSheet(!emergency_->isEnabled() ? ""
                            : picture.emergency_stop ? "background: #f0b429; color: black;"
                                                     : "background: #b01818; color: white;");
  override_->setText(picture.overridden ? "End &override" : "&Override");
  if (!mode_->hasFocus() && !picture.isStale()) {
    mode_->setCurrentIndex(picture.mode.value_or(kNoMode));
  }
  if (!threshold_->hasFocus() && picture.threshold_m > 0.0) {
    threshold_->setValue(picture.threshold_m);
  }
}

}  // namespace slipnav

PLUGINLIB_EXPORT_CLASS(slipnav::StopPanel, rviz::Panel)
