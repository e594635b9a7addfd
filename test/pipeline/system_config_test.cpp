#include "posefusion/pipeline/system_config.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "posefusion/common/package_files.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

std::string WriteYaml(const TemporaryFolder& folder, const std::string& name,
                      const std::string& text) {
  const std::string path = folder.path() + "/" + name;
  std::ofstream(path) << text;
  return path;
}

TEST(SystemConfig, WithoutFilesEverythingIsDefault) {
  EXPECT_EQ(YAML::Dump(ToYaml(LoadSystemConfig({}))), YAML::Dump(ToYaml(SystemConfig())));
}

TEST(SystemConfig, LaterFilesWin) {
  const TemporaryFolder folder;
  const auto first = WriteYaml(folder, "a.yaml", "mapping: {tracking: {icp_weight: 0.5}}");
  const auto second = WriteYaml(
      folder, "b.yaml", "mapping: {tracking: {icp_weight: 0.7}}\nblur_filter: {mode: absolute}");
  const SystemConfig config = LoadSystemConfig({first, second});
  EXPECT_EQ(config.mapping.tracking.icp_weight, 0.7);
  EXPECT_EQ(config.blur_filter.mode, BlurMode::kAbsolute);
}

TEST(SystemConfig, NamesFileAndKeyOfWhatItRefuses) {
  const TemporaryFolder folder;
  const auto path = WriteYaml(folder, "c.yaml", "mapping: {tracking: {icp_wieght: 1}}");
  try {
    LoadSystemConfig({path});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()), path + ": mapping.tracking.icp_wieght: unknown key");
  }
}

TEST(SystemConfig, LeavesTheNodeletsParametersToThem) {
  const TemporaryFolder folder;
  const auto path = WriteYaml(folder, "d.yaml",
                              "mapping: {ros: {queue_size: 9}, splat: {level: 0}, "
                              "frames: {map_frame: world}}\nblur_filter: {ros: {}}");
  EXPECT_EQ(LoadSystemConfig({path}).mapping.splat.level, 0);
}

TEST(SystemConfig, PresetEfUsesEveryFrame) {
  const SystemConfig config = LoadSystemConfig({FindPackageFile("config/presets/ef.yaml")});
  EXPECT_FALSE(config.blur_filter.enabled);
}

}  // namespace
}  // namespace posefusion
