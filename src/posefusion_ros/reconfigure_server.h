#pragma once

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/ros.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "posefusion/config/config.h"
#include "posefusion_ros/reconfigure_messages.h"
#include "posefusion_ros/trouble_log.h"

namespace posefusion {

/// Lets dynamic_reconfigure change some keys of a Config struct while a nodelet runs. Names, types,
/// ranges and defaults are those of the struct; there is no .cfg file. A request is taken as a
/// whole or, with a message, not at all: values out of range are not bent to the range.
template <class Config>
class ReconfigureServer {
 public:
  /// Takes over a checked config; may throw to refuse it.
  using Apply = std::function<void(const Config&)>;

  /// `keys` as in ConfigField. `apply` is called from the callback queue of `private_node`.
  ReconfigureServer(ros::NodeHandle private_node, const Config& current,
                    std::vector<std::string> keys, Apply apply, TroubleLog::Sink log_error)
      : node_(private_node),
        keys_(std::move(keys)),
        apply_(std::move(apply)),
        log_error_(std::move(log_error)),
        config_(current) {
    namespace dr = dynamic_reconfigure;
    descriptions_ = node_.advertise<dr::ConfigDescription>("parameter_descriptions", 1, true);
    updates_ = node_.advertise<dr::Config>("parameter_updates", 1, true);
    descriptions_.publish(ToDescription(LiveFields(Config())));
    updates_.publish(ToConfigMessage(LiveFields(config_)));
    service_ = node_.advertiseService("set_parameters", &ReconfigureServer::OnRequest, this);
  }

  /// What holds now.
  Config config() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return config_;
  }

  /// Changes values from within the nodelet and tells everybody. Throws what `apply` throws.
  void Change(const std::function<void(Config&)>& change) {
    const std::lock_guard<std::mutex> lock(mutex_);
    Config changed = config_;
    change(changed);
    TakeOver(changed);
    updates_.publish(ToConfigMessage(LiveFields(config_)));
  }

 private:
  std::vector<ConfigField> LiveFields(const Config& config) const {
    std::vector<ConfigField> live;
    for (const ConfigField& field : ListFields(config)) {
      if (std::find(keys_.begin(), keys_.end(), field.key) != keys_.end()) live.push_back(field);
    }
    return live;
  }

  bool OnRequest(dynamic_reconfigure::Reconfigure::Request& request,
                 dynamic_reconfigure::Reconfigure::Response& response) {
    const std::lock_guard<std::mutex> lock(mutex_);
    try {
      Config changed = config_;
      ApplyYaml(ToNestedYaml(request.config, LiveFields(config_)), node_.getNamespace(), changed);
      TakeOver(changed);
    } catch (const std::exception& error) {
      log_error_(std::string("nothing is changed: ") + error.what());
    }
    response.config = ToConfigMessage(LiveFields(config_));
    updates_.publish(response.config);
    return true;
  }

  void TakeOver(const Config& changed) {
    apply_(changed);
    config_ = changed;
    TellParameterServer();
  }

  /// So that `rosparam get` and a nodelet that is loaded again have what holds now.
  void TellParameterServer() const {
    for (const ConfigField& field : LiveFields(config_)) {
      std::string name = field.key;
      std::replace(name.begin(), name.end(), '.', '/');
      switch (field.type) {
        case ConfigField::Type::kBool:
          node_.setParam(name, field.value.template as<bool>());
          break;
        case ConfigField::Type::kInt:
          node_.setParam(name, field.value.template as<int>());
          break;
        case ConfigField::Type::kDouble:
          node_.setParam(name, field.value.template as<double>());
          break;
        case ConfigField::Type::kText:
        case ConfigField::Type::kChoice:
          node_.setParam(name, field.value.template as<std::string>());
          break;
      }
    }
  }

  ros::NodeHandle node_;
  const std::vector<std::string> keys_;
  const Apply apply_;
  const TroubleLog::Sink log_error_;
  mutable std::mutex mutex_;
  Config config_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;
};

}  // namespace posefusion
