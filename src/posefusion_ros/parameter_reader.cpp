#include "posefusion_ros/parameter_reader.h"

#include <XmlRpcValue.h>

#include <limits>
#include <sstream>
#include <stdexcept>

namespace posefusion {
namespace {

using XmlRpc::XmlRpcValue;

/// Shortest text that reads back as the same number.
std::string NumberText(double value) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << value;
  return text.str();
}

YAML::Node MapNode(XmlRpcValue& value, const std::string& key) {
  YAML::Node node(YAML::NodeType::Map);
  for (auto& [name, member] : value) node[name] = ToYamlNode(member, key + "." + name);
  return node;
}

YAML::Node ListNode(XmlRpcValue& value, const std::string& key) {
  YAML::Node node(YAML::NodeType::Sequence);
  for (int i = 0; i < value.size(); ++i) {
    node.push_back(ToYamlNode(value[i], key + "[" + std::to_string(i) + "]"));
  }
  return node;
}

}  // namespace

YAML::Node ToYamlNode(const XmlRpcValue& value, const std::string& key) {
  XmlRpcValue copy = value;  // its accessors are not const
  switch (copy.getType()) {
    case XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool>(copy));
    case XmlRpcValue::TypeInt:
      return YAML::Node(static_cast<int>(copy));
    case XmlRpcValue::TypeDouble:
      return YAML::Node(NumberText(copy));
    case XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string>(copy));
    case XmlRpcValue::TypeStruct:
      return MapNode(copy, key);
    case XmlRpcValue::TypeArray:
      return ListNode(copy, key);
    default:
      throw std::invalid_argument(key + ": a parameter of this type cannot be used");
  }
}

YAML::Node ReadPrivateParameters(const ros::NodeHandle& private_node) {
  const std::string& name = private_node.getNamespace();
  XmlRpcValue value;
  if (!private_node.getParam(name, value)) return YAML::Node(YAML::NodeType::Map);
  return ToYamlNode(value, name);
}

}  // namespace posefusion
