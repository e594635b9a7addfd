#include "posefusion/simulation/simulation_config.h"

#include <gmock/gmock.h>

namespace posefusion {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

auto RefusedWith(const std::string& text) {
  return ThrowsMessage<std::invalid_argument>(HasSubstr(text));
}

TEST(ParseSimulationName, ReadsPresetAndOptions) {
  const auto config = ParseSimulationName("sim:hrp_loop?humans=3&seed=7&seconds=12.5");
  ASSERT_TRUE(config);
  EXPECT_EQ(config->preset, "hrp_loop");
  EXPECT_EQ(config->humans, 3);
  EXPECT_EQ(config->seed, 7);
  EXPECT_EQ(config->seconds, 12.5);
}

TEST(ParseSimulationName, FillsInDefaults) {
  const auto config = ParseSimulationName("sim:fr3_xyz");
  ASSERT_TRUE(config);
  EXPECT_EQ(config->seconds, FindPreset("fr3_xyz").seconds);
  EXPECT_EQ(config->humans, SimulationConfig().humans);
}

TEST(ParseSimulationName, LeavesOtherNamesAlone) {
  EXPECT_FALSE(ParseSimulationName("recording.bag"));
  EXPECT_FALSE(ParseSimulationName("folder/sim:fr3_xyz"));
}

TEST(ParseSimulationName, RefusesWhatItCannotUse) {
  const auto parse = [](const std::string& text) { return [=] { ParseSimulationName(text); }; };
  EXPECT_THAT(parse("sim:"), RefusedWith("none of hrp_loop"));
  EXPECT_THAT(parse("sim:moon"), RefusedWith("'moon' is none of"));
  EXPECT_THAT(parse("sim:fr3_xyz?humans=7"), RefusedWith("humans: 7 is outside [0, 6]"));
  EXPECT_THAT(parse("sim:fr3_xyz?humans=1.5"), RefusedWith("'1.5' is not a whole number"));
  EXPECT_THAT(parse("sim:fr3_xyz?humans="), RefusedWith("'' is not a whole number"));
  EXPECT_THAT(parse("sim:fr3_xyz?seed=-1"), RefusedWith("seed: -1 is outside"));
  EXPECT_THAT(parse("sim:fr3_xyz?seed=99999999999"), RefusedWith("is not a whole number"));
  EXPECT_THAT(parse("sim:fr3_xyz?seconds=0"), RefusedWith("seconds: 0 is outside"));
  EXPECT_THAT(parse("sim:fr3_xyz?seconds=nan"), RefusedWith("'nan' is not a number"));
  EXPECT_THAT(parse("sim:fr3_xyz?seconds=1e9"), RefusedWith("is outside"));
  EXPECT_THAT(parse("sim:fr3_xyz?people=2"), RefusedWith("'people' is none of"));
}

TEST(MakeMover, KnowsEveryPreset) {
  for (const SimulationPreset& preset : SimulationPresets()) {
    SimulationConfig config;
    config.preset = preset.name;
    config.seconds = 2;
    const Mover mover = MakeMover(CheckedConfig(config));
    ASSERT_TRUE(mover.head) << preset.name;
    EXPECT_EQ(mover.robot != nullptr, preset.name.rfind("fr3", 0) != 0) << preset.name;
    EXPECT_TRUE(mover.head->T_map_camera(1).matrix().allFinite());
  }
}

}  // namespace
}  // namespace posefusion
