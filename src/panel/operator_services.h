#pragma once
/// The services behind the panel's buttons, called without blocking the window.

#include <ros/node_handle.h>

#include <deque>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace slipnav {

/// Names relative to the namespace of the nodelets.
inline constexpr const char* kStopNowService = "stop_supervisor/stop_now";
inline constexpr const char* kOverrideService = "stop_supervisor/override";
inline constexpr const char* kEmergencyStopService = "stop_supervisor/emergency_stop";
inline constexpr const char* kInitializeService = "initializer/initialize";
inline constexpr const char* kCheckpointService = "filter/save_checkpoint";
inline constexpr const char* kSupervisorParameters = "stop_supervisor/set_parameters";
inline constexpr const char* kForecastParameters = "forecast/set_parameters";

/// Calls of one service are made in order and none is dropped. No service waits for another: an emergency stop must not
/// be held up by one that hangs. One availability check at a time. Each of these in its own thread.
class OperatorServices {
 public:
  explicit OperatorServices(const std::string& name_space) : node_(name_space) {}

  void trigger(const std::string& service);
  void set(const std::string& service, bool on);
  /// Changes one parameter by dynamic_reconfigure.
  void tune(const std::string& service, const std::string& key, const std::string& text);
  void tune(const std::string& service, const std::string& key, double value);

  /// Starts checking which services exist, unless a check is in progress.
  void look();
  /// As of the last completed check.
  bool isThere(const std::string& service);
  /// The answer to a call, once; nothing until there is one.
  std::optional<std::string> answer();

 private:
  using Call = std::function<std::string()>;

  /// The calls of one service.
  struct Line {
    std::future<std::string> current;
    std::deque<Call> waiting;
  };

  void start(const std::string& service, Call call);

  ros::NodeHandle node_;
  std::map<std::string, Line> lines_;
  std::future<std::set<std::string>> look_;
  std::set<std::string> there_;
};

}  // namespace slipnav
