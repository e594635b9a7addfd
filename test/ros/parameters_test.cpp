#include <XmlRpcValue.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "posefusion/pipeline/system_config.h"
#include "posefusion_ros/nodelets/blur_filter_config.h"
#include "posefusion_ros/nodelets/human_removal_config.h"
#include "posefusion_ros/nodelets/mapping_config.h"
#include "posefusion_ros/nodelets/skeleton_ingest_config.h"
#include "posefusion_ros/parameter_reader.h"

namespace posefusion {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kConfigDir = POSEFUSION_CONFIG_DIR;

template <class Config>
std::string Text(const Config& config) {
  return YAML::Dump(ToYaml(config));
}

/// The keys of `node` with those of maps inside.
int CountKeys(const YAML::Node& node) {
  int count = 0;
  for (const auto& entry : node) count += entry.second.IsMap() ? CountKeys(entry.second) : 1;
  return count;
}

TEST(Parameters, XmlRpcTreeBecomesYaml) {
  XmlRpc::XmlRpcValue value;
  value["ros"]["queue_size"] = 7;
  value["ros"]["path_period_s"] = 0.1;
  value["ros"]["tf"]["publish"] = false;
  value["ros"]["output_dir"] = std::string("/tmp/with space: and colon");
  MappingRosConfig config;
  ApplyYaml(ToYamlNode(value, "/mapping")["ros"], "/mapping.ros", config);
  EXPECT_EQ(config.queue_size, 7);
  EXPECT_EQ(config.path_period_s, 0.1);
  EXPECT_FALSE(config.tf.publish);
  EXPECT_EQ(config.output_dir, "/tmp/with space: and colon");
}

TEST(Parameters, UnknownKeysAndValuesOutOfRangeNameTheFullKey) {
  const auto apply = [](const XmlRpc::XmlRpcValue& value) {
    MappingConfig config;
    ApplyYaml(ToYamlNode(value, "/mapping"), "/mapping", config);
  };
  XmlRpc::XmlRpcValue unknown;
  unknown["ros"]["queue_sise"] = 7;
  EXPECT_THAT([&] { apply(unknown); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("/mapping.ros.queue_sise")));
  XmlRpc::XmlRpcValue too_big;
  too_big["ros"]["num_threads"] = 1000;
  EXPECT_THAT([&] { apply(too_big); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("/mapping.ros.num_threads")));
}

TEST(Parameters, FramesOfHrp4AreAFileOfDifferences) {
  const YAML::Node node = LoadYamlFile(kConfigDir + "/hrp4.yaml");
  MappingConfig config;
  ApplyYaml(node["mapping"], "mapping", config);
  EXPECT_EQ(config.frames.odom_frame, "odom_init");
  EXPECT_EQ(config.frames.base_frame, "BODY");
  HumanRemovalNodeletConfig human_removal;
  ApplyYaml(node["human_removal"], "human_removal", human_removal);
  EXPECT_EQ(human_removal.frames.odom_frame, config.frames.odom_frame);
  EXPECT_EQ(node.size(), 2U);
  EXPECT_NO_THROW(LoadSystemConfig({kConfigDir + "/hrp4.yaml"}));
}

TEST(Parameters, ShippedMappingFilesHoldEveryKeyWithItsDefault) {
  YAML::Node node = LoadYamlFile(kConfigDir + "/mapping.yaml");
  node["frames"] = LoadYamlFile(kConfigDir + "/frames.yaml")["frames"];
  MappingConfig config;
  ApplyYaml(node, "mapping", config);
  EXPECT_EQ(Text(config), Text(MappingConfig()));
  EXPECT_EQ(CountKeys(node["ros"]), CountKeys(ToYaml(MappingRosConfig())));
  EXPECT_EQ(CountKeys(node["frames"]), CountKeys(ToYaml(FramesConfig())));
}

TEST(Parameters, ShippedBlurFilterFileHoldsEveryKeyWithItsDefault) {
  const YAML::Node node = LoadYamlFile(kConfigDir + "/blur_filter.yaml");
  BlurFilterNodeletConfig config;
  ApplyYaml(node, "blur_filter", config);
  EXPECT_EQ(Text(config), Text(BlurFilterNodeletConfig()));
  EXPECT_EQ(CountKeys(node), CountKeys(ToYaml(config)));
}

TEST(Parameters, ShippedHumanRemovalFileHoldsEveryKeyWithItsDefault) {
  YAML::Node node = LoadYamlFile(kConfigDir + "/human_removal.yaml");
  node["frames"] = LoadYamlFile(kConfigDir + "/frames.yaml")["frames"];
  HumanRemovalNodeletConfig config;
  ApplyYaml(node, "human_removal", config);
  EXPECT_EQ(Text(config), Text(HumanRemovalNodeletConfig()));
  EXPECT_EQ(CountKeys(node), CountKeys(ToYaml(config)));
}

TEST(Parameters, ShippedSkeletonIngestFileHoldsEveryKeyWithItsDefault) {
  YAML::Node node = LoadYamlFile(kConfigDir + "/skeleton_ingest.yaml");
  node["network"] = LoadYamlFile(kConfigDir + "/pose_network.yaml");
  SkeletonIngestConfig config;
  ApplyYaml(node, "skeleton_ingest", config);
  EXPECT_EQ(Text(config), Text(SkeletonIngestConfig()));
  EXPECT_EQ(CountKeys(node), CountKeys(ToYaml(config)));
}

}  // namespace
}  // namespace posefusion
