#pragma once

#include <ros/node_handle.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "posefusion/config/config.h"
#include "posefusion/pipeline/camera_info_config.h"

namespace posefusion {

/// The value of a ROS parameter as yaml. @throws std::invalid_argument naming `key` for types that
/// yaml files cannot give (dates, binary data).
YAML::Node ToYamlNode(const XmlRpc::XmlRpcValue& value, const std::string& key);

/// All parameters in a node's private namespace; an empty map when there are none.
YAML::Node ReadPrivateParameters(const ros::NodeHandle& private_node);

/// A Config filled from the private parameters of a node. Parameters that are not set keep their
/// defaults. @throws std::invalid_argument naming the full key for unknown keys, wrong types and
/// values out of range.
template <class Config>
Config ReadConfig(const ros::NodeHandle& private_node) {
  Config config;
  ApplyYaml(ReadPrivateParameters(private_node), private_node.getNamespace(), config);
  return config;
}

/// The group camera_info beside the nodelets, which those share that read camera_info.
/// @throws std::invalid_argument as ReadConfig.
inline CameraInfoConfig ReadCameraInfoConfig(const ros::NodeHandle& node) {
  return ReadConfig<CameraInfoConfig>(ros::NodeHandle(node, "camera_info"));
}

}  // namespace posefusion
