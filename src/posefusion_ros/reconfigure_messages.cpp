#include "posefusion_ros/reconfigure_messages.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace posefusion {
namespace {

using Type = ConfigField::Type;
using dynamic_reconfigure::Config;

const char* TypeName(Type type) {
  switch (type) {
    case Type::kBool:
      return "bool";
    case Type::kInt:
      return "int";
    case Type::kDouble:
      return "double";
    case Type::kText:
    case Type::kChoice:
      return "str";
  }
  return "str";
}

/// What rqt_reconfigure makes a list of: a dictionary of Python.
std::string EditMethod(const ConfigField& field) {
  if (field.type != Type::kChoice) return "";
  std::string text = "{'enum_description': '', 'enum': [";
  for (const std::string& choice : field.choices) {
    text +=
        "{'name': '" + choice + "', 'type': 'str', 'value': '" + choice + "', 'description': ''}, ";
  }
  return text + "]}";
}

template <class Parameter, class Value>
void Append(std::vector<Parameter>& parameters, const std::string& name, const Value& value) {
  Parameter parameter;
  parameter.name = name;
  parameter.value = value;
  parameters.push_back(parameter);
}

void AppendValue(const ConfigField& field, Config& config) {
  const std::string name = ReconfigureName(field.key);
  switch (field.type) {
    case Type::kBool:
      return Append(config.bools, name, static_cast<std::uint8_t>(field.value.as<bool>()));
    case Type::kInt:
      return Append(config.ints, name, field.value.as<int>());
    case Type::kDouble:
      return Append(config.doubles, name, field.value.as<double>());
    case Type::kText:
    case Type::kChoice:
      return Append(config.strs, name, field.value.as<std::string>());
  }
}

void AddDefaultGroup(Config& config) {
  dynamic_reconfigure::GroupState group;
  group.name = "Default";
  group.state = 1;
  config.groups.push_back(group);
}

/// Smallest or largest values; what has no range keeps its value.
Config Limits(std::vector<ConfigField> fields, bool largest) {
  for (ConfigField& field : fields) {
    const double limit = largest ? field.max : field.min;
    if (field.type == Type::kBool) field.value = largest;
    if (field.type == Type::kInt) field.value = static_cast<int>(limit);
    if (field.type == Type::kDouble) field.value = limit;
  }
  return ToConfigMessage(fields);
}

const ConfigField& FindField(const std::string& name, Type type,
                             const std::vector<ConfigField>& fields) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const ConfigField& field) {
    return ReconfigureName(field.key) == name;
  });
  if (found == fields.end()) throw std::invalid_argument(name + ": cannot be changed here");
  if (std::string(TypeName(found->type)) != TypeName(type)) {
    throw std::invalid_argument(name + ": is of type " + TypeName(found->type) + ", not " +
                                TypeName(type));
  }
  return *found;
}

void SetNested(YAML::Node node, const std::string& key, const YAML::Node& value) {
  const auto dot = key.find('.');
  if (dot == std::string::npos) {
    node[key] = value;
  } else {
    SetNested(node[key.substr(0, dot)], key.substr(dot + 1), value);
  }
}

/// Shortest text that reads back as the same number.
YAML::Node ExactNumber(double value) {
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << value;
  return YAML::Node(text.str());
}

}  // namespace

std::string ReconfigureName(const std::string& key) {
  std::string name = key;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

dynamic_reconfigure::ConfigDescription ToDescription(const std::vector<ConfigField>& defaults) {
  dynamic_reconfigure::Group group;
  group.name = "Default";
  for (const ConfigField& field : defaults) {
    dynamic_reconfigure::ParamDescription parameter;
    parameter.name = ReconfigureName(field.key);
    parameter.type = TypeName(field.type);
    parameter.description = field.key + " of the yaml file, which says what it means";
    parameter.edit_method = EditMethod(field);
    group.parameters.push_back(parameter);
  }
  dynamic_reconfigure::ConfigDescription description;
  description.groups.push_back(group);
  description.dflt = ToConfigMessage(defaults);
  description.min = Limits(defaults, false);
  description.max = Limits(defaults, true);
  return description;
}

dynamic_reconfigure::Config ToConfigMessage(const std::vector<ConfigField>& fields) {
  Config config;
  for (const ConfigField& field : fields) AppendValue(field, config);
  AddDefaultGroup(config);
  return config;
}

YAML::Node ToNestedYaml(const Config& request, const std::vector<ConfigField>& fields) {
  YAML::Node node(YAML::NodeType::Map);
  for (const auto& parameter : request.bools) {
    SetNested(node, FindField(parameter.name, Type::kBool, fields).key,
              YAML::Node(parameter.value != 0));
  }
  for (const auto& parameter : request.ints) {
    SetNested(node, FindField(parameter.name, Type::kInt, fields).key, YAML::Node(parameter.value));
  }
  for (const auto& parameter : request.doubles) {
    SetNested(node, FindField(parameter.name, Type::kDouble, fields).key,
              ExactNumber(parameter.value));
  }
  for (const auto& parameter : request.strs) {
    SetNested(node, FindField(parameter.name, Type::kText, fields).key,
              YAML::Node(parameter.value));
  }
  return node;
}

}  // namespace posefusion
