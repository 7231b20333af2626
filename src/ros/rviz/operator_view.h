#pragma once
/// What an operator needs to know at a glance, collected from messages. Independent of any GUI.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <slipnav/ErrorForecast.h>
#include <slipnav/Initialization.h>
#include <slipnav/Slip.h>
#include <slipnav/StopStatus.h>
#include <std_msgs/String.h>

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace slipnav {

/// How urgent the display is.
enum class Mood { kStale, kStart, kDriving, kAhead, kStopping, kDanger };

/// One complaint of the diagnostics.
struct OperatorAlarm {
  int level = 0;  ///< as in diagnostic_msgs/DiagnosticStatus
  std::string words;
};

/// One moment.
struct OperatorPicture {
  Mood mood = Mood::kStale;
  std::string state;      ///< in one or two words
  std::string countdown;  ///< the only one; "" if there is none
  std::string reason;
  std::string slip;
  std::string since_stop;
  std::string figures;            ///< of the whole drive; "" without Overlay
  std::optional<double> bound_m;  ///< now
  double threshold_m = 0.0;
  std::vector<std::pair<double, double>> history;  ///< age [s] and bound [m], oldest first
  std::vector<OperatorAlarm> alarms;               ///< worst first
  bool emergency_stop = false;
  bool overridden = false;
  std::optional<int> mode;  ///< as in slipnav/StopStatus; the supervisor says nothing before the first estimate

  bool isStale() const { return mood == Mood::kStale; }
};

/// All times are real time [s], of a monotonic clock. Old values are not shown.
class OperatorView {
 public:
  void take(const StopStatus& message, double now_s);
  void take(const ErrorForecast& message, double now_s);
  void take(const Slip& message, double now_s);
  void take(const Initialization& message, double now_s);
  void take(const std_msgs::String& figures, double now_s);
  void take(const diagnostic_msgs::DiagnosticArray& message, double now_s);

  OperatorPicture picture(double now_s) const;

 private:
  template <class Message>
  struct Heard {
    Message message;
    double time_s = -1e9;
  };

  /// Whether a start is still being looked for; not if its nodelet has ended meanwhile.
  bool isStarting(double now_s) const;
  void describe(const StopStatus& stop, OperatorPicture& picture) const;
  void addForecast(double now_s, OperatorPicture& picture) const;
  void addAlarms(double now_s, OperatorPicture& picture) const;

  std::optional<Heard<StopStatus>> stop_;
  std::optional<Heard<ErrorForecast>> forecast_;
  std::optional<Heard<Slip>> slip_;
  std::optional<Heard<Initialization>> start_;
  std::optional<Heard<std_msgs::String>> figures_;
  std::deque<std::pair<double, double>> bounds_;  ///< time [s] and bound [m]
  std::map<std::string, Heard<diagnostic_msgs::DiagnosticStatus>> statuses_;
  double since_stop_m_ = 0.0;
};

}  // namespace slipnav
