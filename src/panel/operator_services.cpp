#include "panel/operator_services.h"

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/service.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <array>
#include <chrono>
#include <utility>

#include "ros/runtime/tuning_messages.h"

namespace slipnav {
namespace {

template <class Result>
bool isDone(const std::future<Result>& future) {
  return future.valid() && future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

template <class Service>
std::string callService(const std::string& name, Service service) {
  if (!ros::service::call(name, service)) {
    return name + " does not answer";
  }
  return (service.response.success != 0 ? "" : "failed: ") + service.response.message;
}

std::string reconfigure(const std::string& name, const dynamic_reconfigure::Config& values, const std::string& key,
                        const std::string& wanted) {
  dynamic_reconfigure::Reconfigure service;
  service.request.config = values;
  if (!ros::service::call(name, service)) {
    return name + " does not answer";
  }
  for (const ParameterChange& change : changesOf(service.response.config)) {
    if (change.key == key) {
      const std::string now = toText(change.value);
      return now == wanted ? key + " is " + now : "refused: " + key + " stays " + now;
    }
  }
  return "refused: " + key;
}

}  // namespace

void OperatorServices::start(const std::string& service, Call call) {
  Line& line = lines_[service];
  if (line.current.valid()) {
    line.waiting.push_back(std::move(call));
    return;
  }
  line.current = std::async(std::launch::async, std::move(call));
}

void OperatorServices::trigger(const std::string& service) {
  start(service, [name = node_.resolveName(service)] { return callService(name, std_srvs::Trigger()); });
}

void OperatorServices::set(const std::string& service, bool on) {
  std_srvs::SetBool request;
  request.request.data = on ? 1 : 0;
  start(service, [name = node_.resolveName(service), request] { return callService(name, request); });
}

void OperatorServices::tune(const std::string& service, const std::string& key, const std::string& text) {
  const dynamic_reconfigure::Config values = toValues({{key, text, {}, {}, ""}});
  start(service,
        [name = node_.resolveName(service), values, key, text] { return reconfigure(name, values, key, text); });
}

void OperatorServices::tune(const std::string& service, const std::string& key, double value) {
  const dynamic_reconfigure::Config values = toValues({{key, value, {}, {}, ""}});
  start(service, [name = node_.resolveName(service), values, key, wanted = toText(ParameterValue(value))] {
    return reconfigure(name, values, key, wanted);
  });
}

void OperatorServices::look() {
  if (look_.valid()) {
    return;
  }
  look_ = std::async(std::launch::async, [this] {
    std::set<std::string> there;
    for (const char* service : {kStopNowService, kOverrideService, kEmergencyStopService, kInitializeService,
                                kCheckpointService, kSupervisorParameters, kForecastParameters}) {
      if (ros::service::exists(node_.resolveName(service), false)) {
        there.insert(service);
      }
    }
    return there;
  });
}

bool OperatorServices::isThere(const std::string& service) {
  if (isDone(look_)) {
    there_ = look_.get();
  }
  return there_.count(service) > 0;
}

std::optional<std::string> OperatorServices::answer() {
  for (auto& [service, line] : lines_) {
    if (!isDone(line.current)) {
      continue;
    }
    const std::string words = line.current.get();
    if (!line.waiting.empty()) {
      start(service, std::move(line.waiting.front()));
      line.waiting.pop_front();
    }
    return words;
  }
  return std::nullopt;
}

}  // namespace slipnav
