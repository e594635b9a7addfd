#include "posefusion/pipeline/system_config.h"

#include <stdexcept>

namespace posefusion {

SystemConfig LoadSystemConfig(const std::vector<std::string>& yaml_paths) {
  SystemConfig config;
  for (const std::string& path : yaml_paths) {
    YAML::Node node = LoadYamlFile(path);
    for (const char* group : {"blur_filter", "mapping"}) {
      // The nodelets' own parameters may stand in the same file.
      if (node.IsMap() && node[group] && node[group].IsMap()) node[group].remove("ros");
    }
    try {
      ApplyYaml(node, "", config);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(path + ": " + error.what());
    }
  }
  return config;
}

}  // namespace posefusion
