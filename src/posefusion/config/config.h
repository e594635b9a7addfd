#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <type_traits>
#include <vector>

namespace posefusion {

/// Configuration by plain structs. Each struct has its defaults at its fields and one function
///
///   template <class V> void Describe(V& visitor, SomeConfig& config) {
///     visitor.Field("radius_m", config.radius_m, 0.01, 1.0);          // number with its range
///     visitor.Field("enabled", config.enabled);                       // bool or text
///     visitor.Choice("policy", config.policy, {"wait", "pass"});      // enum, in order of values
///     visitor.Group("min_cut", config.min_cut);                       // nested struct
///   }
///
/// that names every key once. Readers and printers below are visitors of it.

/// Reads values from a yaml map. Missing keys keep their value.
/// Throws std::invalid_argument naming the full key ("mapping.tracking.icp_weight") for a value
/// of another type, out of range, or (at the end of a group) a key that nobody asked for.
class ConfigReader {
 public:
  ConfigReader(YAML::Node node, std::string prefix);

  void Field(const char* key, bool& value);
  void Field(const char* key, std::string& value);
  template <class Number>
  void Field(const char* key, Number& value, Number min, Number max) {
    static_assert(std::is_same_v<Number, int> || std::is_same_v<Number, double>);
    ReadNumber(key, value, min, max);
  }
  template <class Enum>
  void Choice(const char* key, Enum& value, const std::vector<const char*>& names) {
    value = static_cast<Enum>(ReadChoice(key, static_cast<int>(value), names));
  }
  template <class Config>
  void Group(const char* key, Config& config) {
    ConfigReader group(Take(key), FullKey(key));
    Describe(group, config);
    group.RefuseUnknownKeys();
  }

  /// Throws for the first key of this group that no Field, Choice or Group has read.
  void RefuseUnknownKeys() const;

 private:
  YAML::Node Take(const char* key);
  std::string FullKey(const std::string& key) const;
  void ReadNumber(const char* key, int& value, int min, int max);
  void ReadNumber(const char* key, double& value, double min, double max);
  int ReadChoice(const char* key, int value, const std::vector<const char*>& names);

  YAML::Node node_;
  std::string prefix_;
  std::vector<std::string> known_keys_;
};

/// Writes every key with its current value into a yaml map.
class ConfigPrinter {
 public:
  void Field(const char* key, const bool& value) { node_[key] = value; }
  void Field(const char* key, const std::string& value) { node_[key] = value; }
  template <class Number>
  void Field(const char* key, const Number& value, Number, Number) {
    node_[key] = value;
  }
  template <class Enum>
  void Choice(const char* key, const Enum& value, const std::vector<const char*>& names) {
    node_[key] = std::string(names.at(static_cast<std::size_t>(value)));
  }
  template <class Config>
  void Group(const char* key, Config& config) {
    ConfigPrinter group;
    Describe(group, config);
    node_[key] = group.node();
  }

  const YAML::Node& node() const { return node_; }

 private:
  YAML::Node node_{YAML::NodeType::Map};
};

/// Overlays the values of `node` on `config`. `name` starts the keys in error messages.
/// @throws std::invalid_argument as ConfigReader does; `config` is then partly changed.
template <class Config>
void ApplyYaml(const YAML::Node& node, const std::string& name, Config& config) {
  ConfigReader reader(node, name);
  Describe(reader, config);
  reader.RefuseUnknownKeys();
}

/// Checks every field against its range. @throws std::invalid_argument naming the full key.
template <class Config>
void CheckRanges(const std::string& name, const Config& config) {
  Config copy = config;
  ConfigPrinter printer;
  Describe(printer, copy);
  ApplyYaml(printer.node(), name, copy);
}

/// All keys and values as a yaml map.
template <class Config>
YAML::Node ToYaml(const Config& config) {
  Config copy = config;
  ConfigPrinter printer;
  Describe(printer, copy);
  return printer.node();
}

/// Reads a yaml file. @throws std::invalid_argument naming the file, and the line of a syntax
/// error.
YAML::Node LoadYamlFile(const std::string& path);

}  // namespace posefusion
