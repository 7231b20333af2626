#pragma once
/// slipnav/StopPanel: what a rover operator sees and does, as an rviz panel.

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <rviz/panel.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ros/rviz/operator_view.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QTimer;

namespace slipnav {

class BoundChart;
class OperatorServices;

/// Subscribes in the namespace of the node, and calls the services there.
class StopPanel : public rviz::Panel {
  Q_OBJECT

 public:
  explicit StopPanel(QWidget* parent = nullptr);
  ~StopPanel() override;

 private:
  void buildWords();
  void buildButtons();
  QPushButton* button(const char* name, const QString& words, const std::function<void()>& action);
  template <class Message>
  void listen(const std::string& topic);
  void refresh();
  void showPicture(const OperatorPicture& picture);
  void showButtons(const OperatorPicture& picture);
  void enable(QWidget* widget, const std::string& service, bool needs_data, const OperatorPicture& picture);
  void onEmergencyStop();
  void onThreshold();

  ros::NodeHandle node_;
  std::vector<ros::Subscriber> subscribers_;
  OperatorView view_;
  std::unique_ptr<OperatorServices> services_;
  OperatorPicture shown_;
  double looked_s_ = -1e9;
  double release_armed_s_ = -1e9;  ///< the first of two clicks
  QLabel* state_ = nullptr;
  QLabel* countdown_ = nullptr;
  QLabel* reason_ = nullptr;
  QLabel* numbers_ = nullptr;
  QLabel* alarms_ = nullptr;
  QLabel* answer_ = nullptr;
  BoundChart* chart_ = nullptr;
  QPushButton* emergency_ = nullptr;
  QPushButton* stop_now_ = nullptr;
  QPushButton* override_ = nullptr;
  QPushButton* initialize_ = nullptr;
  QPushButton* checkpoint_ = nullptr;
  QComboBox* mode_ = nullptr;
  QDoubleSpinBox* threshold_ = nullptr;
  QTimer* timer_ = nullptr;
};

}  // namespace slipnav
