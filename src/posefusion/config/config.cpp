#include "posefusion/config/config.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace posefusion {
namespace {

/// The scalar as T; throws naming the key when it is of another type.
template <class T>
T ScalarAs(const YAML::Node& node, const std::string& key, const char* type) {
  try {
    return node.as<T>();
  } catch (const YAML::Exception&) {
    throw std::invalid_argument(key + ": expected " + type + ", got '" + YAML::Dump(node) + "'");
  }
}

template <class Number>
void CheckRange(const std::string& key, Number value, Number min, Number max) {
  if (value >= min && value <= max) return;
  std::ostringstream message;
  message << key << ": " << value << " is outside [" << min << ", " << max << "]";
  throw std::invalid_argument(message.str());
}

}  // namespace

ConfigReader::ConfigReader(YAML::Node node, std::string prefix)
    : node_(node.IsDefined() ? std::move(node) : YAML::Node(YAML::NodeType::Null)),
      prefix_(std::move(prefix)) {
  if (!node_.IsNull() && !node_.IsMap()) {
    throw std::invalid_argument(prefix_ + ": expected a map of keys, got '" + YAML::Dump(node_) +
                                "'");
  }
}

std::string ConfigReader::FullKey(const std::string& key) const {
  return prefix_.empty() ? key : prefix_ + "." + key;
}

YAML::Node ConfigReader::Take(const char* key) {
  known_keys_.emplace_back(key);
  if (!node_.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
  const YAML::Node& constant = node_;  // operator[] of a mutable node would add the key
  return constant[key];
}

void ConfigReader::Field(const char* key, bool& value) {
  const YAML::Node node = Take(key);
  if (node.IsDefined()) value = ScalarAs<bool>(node, FullKey(key), "true or false");
}

void ConfigReader::Field(const char* key, std::string& value) {
  const YAML::Node node = Take(key);
  if (node.IsDefined()) value = ScalarAs<std::string>(node, FullKey(key), "text");
}

void ConfigReader::ReadNumber(const char* key, int& value, int min, int max) {
  const YAML::Node node = Take(key);
  if (node.IsDefined()) value = ScalarAs<int>(node, FullKey(key), "a whole number");
  CheckRange(FullKey(key), value, min, max);
}

void ConfigReader::ReadNumber(const char* key, double& value, double min, double max) {
  const YAML::Node node = Take(key);
  if (node.IsDefined()) value = ScalarAs<double>(node, FullKey(key), "a number");
  CheckRange(FullKey(key), value, min, max);
}

int ConfigReader::ReadChoice(const char* key, int value, const std::vector<const char*>& names) {
  const YAML::Node node = Take(key);
  if (!node.IsDefined()) return value;
  const auto text = ScalarAs<std::string>(node, FullKey(key), "text");
  const auto found = std::find(names.begin(), names.end(), text);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  std::string message = FullKey(key) + ": '" + text + "' is none of";
  for (const char* name : names) message += std::string(" ") + name;
  throw std::invalid_argument(message);
}

void ConfigReader::RefuseUnknownKeys() const {
  if (!node_.IsMap()) return;
  for (const auto& entry : node_) {
    const auto key = entry.first.as<std::string>();
    if (std::find(known_keys_.begin(), known_keys_.end(), key) == known_keys_.end()) {
      throw std::invalid_argument(FullKey(key) + ": unknown key");
    }
  }
}

YAML::Node LoadYamlFile(const std::string& path) {
  try {
    return YAML::LoadFile(path);
  } catch (const YAML::BadFile&) {
    throw std::invalid_argument(path + ": cannot be read");
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(path + ": " + error.what());
  }
}

}  // namespace posefusion
