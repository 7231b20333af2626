#include "ros/runtime/tuning_server.h"

#include <ros/master.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <stdexcept>

#include "ros/runtime/internal_topics.h"
#include "ros/runtime/tuning_messages.h"

namespace slipnav {

TuningServer::TuningServer(ros::NodeHandle& node, ros::NodeHandle& own, const std::string& nodelet,
                           const Config& loaded, const Service& service)
    : nodelet_(nodelet),
      loaded_(tunableParameters(nodelet, loaded)),
      present_(loaded_),
      updates_(own, "parameter_updates", true),
      descriptions_(own, "parameter_descriptions", true),
      others_(node, kTuningTopic, true) {
  descriptions_.publish(boost::make_shared<const dynamic_reconfigure::ConfigDescription>(toDescription(loaded_)));
  announce();
  service_ = own.advertiseService("set_parameters", service);
}

Config TuningServer::requested(const dynamic_reconfigure::Config& request, const Config& present) const {
  const std::vector<ParameterChange> changes = changesOf(request);
  for (const ParameterChange& change : changes) {
    const bool offered = std::any_of(present_.begin(), present_.end(),
                                     [&change](const ParameterInfo& parameter) { return parameter.key == change.key; });
    if (!offered) {
      throw std::invalid_argument("'" + change.key + "' cannot be changed here while running");
    }
  }
  return withChanges(present, changes);
}

std::vector<ParameterDifference> TuningServer::take(const Config& present) {
  const std::vector<ParameterInfo> before = present_;
  present_ = tunableParameters(nodelet_, present);
  std::vector<ParameterDifference> changed = differences(before, present_);
  if (!changed.empty()) {
    others_.publish(boost::make_shared<const dynamic_reconfigure::Config>(toValues(present_)));
  }
  return changed;
}

dynamic_reconfigure::Config TuningServer::announce() {
  const auto message = boost::make_shared<const dynamic_reconfigure::Config>(toValues(present_));
  updates_.publish(message);
  return *message;
}

void store(const std::vector<ParameterDifference>& changed, const std::string& tree) {
  for (const ParameterDifference& item : changed) {
    std::string name = tree + "/" + item.key;
    std::replace(name.begin(), name.end(), '.', '/');
    XmlRpc::XmlRpcValue request;
    XmlRpc::XmlRpcValue response;
    XmlRpc::XmlRpcValue payload;
    request[0] = ros::this_node::getName();
    request[1] = name;
    std::visit([&request](const auto& value) { request[2] = value; }, item.after);
    ros::master::execute("setParam", request, response, payload, false);
  }
}

}  // namespace slipnav
