// The shipped files in config/ show every key with its default, so that there is one truth.

#include <gtest/gtest.h>

#include <functional>
#include <ostream>

#include "posefusion/config/config.h"
#include "posefusion/image/blur_filter.h"
#include "posefusion/pipeline/camera_info_config.h"
#include "posefusion/pipeline/slam_config.h"
#include "posefusion/segmentation/human_removal_config.h"
#include "posefusion/skeleton/pose_network_config.h"

namespace posefusion {
namespace {

/// A file of config/ with the defaults of its Config struct and the values after reading the file.
struct ConfigFile {
  const char* name;
  std::function<YAML::Node()> defaults;
  std::function<YAML::Node(const YAML::Node&)> after_reading;
};

std::ostream& operator<<(std::ostream& stream, const ConfigFile& file) {
  return stream << file.name;
}

template <class Config>
ConfigFile FileOf(const char* name) {
  return {name, [] { return ToYaml(Config()); },
          [name](const YAML::Node& node) {
            Config config;
            ApplyYaml(node, name, config);
            return ToYaml(config);
          }};
}

/// Expects that every key of `defaults` is in `node`, groups included.
void ExpectAllKeys(const YAML::Node& defaults, const YAML::Node& node, const std::string& prefix) {
  for (const auto& entry : defaults) {
    const auto key = entry.first.as<std::string>();
    const YAML::Node value = node[key];
    EXPECT_TRUE(value.IsDefined()) << prefix + key << " is missing";
    if (entry.second.IsMap() && value.IsDefined()) ExpectAllKeys(entry.second, value, key + ".");
  }
}

class ConfigFilesTest : public testing::TestWithParam<ConfigFile> {};

TEST_P(ConfigFilesTest, ShowsEveryKeyWithItsDefault) {
  YAML::Node node = LoadYamlFile(std::string(POSEFUSION_CONFIG_FOLDER) + "/" + GetParam().name);
  node.remove("ros");  // belongs to the nodelet, not to the core's struct
  ExpectAllKeys(GetParam().defaults(), node, "");
  EXPECT_EQ(YAML::Dump(GetParam().after_reading(node)), YAML::Dump(GetParam().defaults()));
}

// One line per file whose struct is in the core.
INSTANTIATE_TEST_SUITE_P(All, ConfigFilesTest,
                         testing::Values(FileOf<BlurFilterConfig>("blur_filter.yaml"),
                                         FileOf<CameraInfoConfig>("camera_info.yaml"),
                                         FileOf<HumanRemovalConfig>("human_removal.yaml"),
                                         FileOf<SlamConfig>("mapping.yaml"),
                                         FileOf<PoseNetworkConfig>("pose_network.yaml")));

}  // namespace
}  // namespace posefusion
