#include "posefusion/pipeline/system_config.h"

#include <stdexcept>

namespace posefusion {

SystemConfig LoadSystemConfig(const std::vector<std::string>& yaml_paths) {
  SystemConfig config;
  for (const std::string& path : yaml_paths) {
    const YAML::Node node = LoadYamlFile(path);
    try {
      ApplyYaml(node, "", config);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(path + ": " + error.what());
    }
  }
  return config;
}

}  // namespace posefusion
