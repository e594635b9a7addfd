#include "posefusion/pipeline/system_config.h"

#include <stdexcept>
#include <utility>

namespace posefusion {
namespace {

/// The nodelets' own groups, which may stand in the same file.
constexpr std::pair<const char*, const char*> kNodeletGroups[] = {{"blur_filter", "ros"},
                                                                  {"human_removal", "ros"},
                                                                  {"human_removal", "frames"},
                                                                  {"mapping", "ros"},
                                                                  {"mapping", "frames"}};

}  // namespace

SystemConfig LoadSystemConfig(const std::vector<std::string>& yaml_paths) {
  SystemConfig config;
  for (const std::string& path : yaml_paths) {
    YAML::Node node = LoadYamlFile(path);
    for (const auto& [group, nodelet_group] : kNodeletGroups) {
      if (node.IsMap() && node[group] && node[group].IsMap()) node[group].remove(nodelet_group);
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
