#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

namespace posefusion {

/// One key of a Config struct with its value and range.
struct ConfigField {
  enum class Type { kBool, kText, kInt, kDouble, kChoice };
  std::string key;  ///< with its groups: "min_cut.sigma_m"
  Type type = Type::kText;
  YAML::Node value;
  double min = 0;  ///< of numbers
  double max = 0;
  std::vector<std::string> choices;  ///< of a choice
};

/// Visitor that lists every key of a Config struct in order.
class ConfigLister {
 public:
  void Field(const char* key, const bool& value) {
    Add(key, ConfigField::Type::kBool, YAML::Node(value));
  }
  void Field(const char* key, const std::string& value) {
    Add(key, ConfigField::Type::kText, YAML::Node(value));
  }
  void Field(const char* key, const int& value, int min, int max) {
    Add(key, ConfigField::Type::kInt, YAML::Node(value), min, max);
  }
  void Field(const char* key, const double& value, double min, double max) {
    Add(key, ConfigField::Type::kDouble, YAML::Node(value), min, max);
  }
  template <class Enum>
  void Choice(const char* key, const Enum& value, const std::vector<const char*>& names) {
    const std::string name = names.at(static_cast<std::size_t>(value));
    Add(key, ConfigField::Type::kChoice, YAML::Node(name));
    fields_.back().choices.assign(names.begin(), names.end());
  }
  template <class Config>
  void Group(const char* key, Config& config) {
    const std::string outer = prefix_;
    prefix_ += std::string(key) + ".";
    Describe(*this, config);
    prefix_ = outer;
  }

  const std::vector<ConfigField>& fields() const { return fields_; }

 private:
  void Add(const char* key, ConfigField::Type type, YAML::Node value, double min = 0,
           double max = 0) {
    fields_.push_back({prefix_ + key, type, std::move(value), min, max, {}});
  }

  std::string prefix_;
  std::vector<ConfigField> fields_;
};

/// All keys of a Config struct in order.
template <class Config>
std::vector<ConfigField> ListFields(const Config& config) {
  Config copy = config;
  ConfigLister lister;
  Describe(lister, copy);
  return lister.fields();
}

}  // namespace posefusion
