#include <gmock/gmock.h>

#include <filesystem>

#include "test/support/program_run.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::HasSubstr;

ProgramRun Simulate(const std::string& arguments) { return RunProgram(SIMULATE, arguments); }

TEST(Simulate, MakesFolderAndBag) {
  const TemporaryFolder folder;
  const std::string out = folder / "run";
  const std::string bag = folder / "run.bag";
  const ProgramRun run =
      Simulate("--preset hrp_loop --humans 0 --seconds 0.1 --out " + out + " --bag " + bag);
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("3 frames of hrp_loop"));
  EXPECT_TRUE(std::filesystem::exists(out + "/simulation.yaml"));
  EXPECT_TRUE(std::filesystem::exists(bag));
}

TEST(Simulate, TellsUsageErrorsFromOthers) {
  const TemporaryFolder folder;
  const std::string out = " --out " + (folder / "run");
  ProgramRun run = Simulate("--preset moon" + out);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.output, HasSubstr("'moon' is none of hrp_loop"));
  for (const char* seconds : {"-3", "0", "nan", "inf", "1e9", "long"}) {
    run = Simulate("--preset fr3_xyz --seconds " + (seconds + out));
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.output, HasSubstr("--seconds")) << seconds;
  }
  run = Simulate("--preset fr3_xyz --seed text" + out);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.output, HasSubstr("--seed"));
  run = Simulate("--preset fr3_xyz --humans 99" + out);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.output, HasSubstr("--humans: 99 is outside"));
  run = Simulate("--preset fr3_xyz --seconds 0.1 --out /proc/run");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("/proc/run"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Simulate, LeavesNothingOnAFullDisk) {
  const TemporaryFolder folder;
  const std::string out = folder / "run";
  // Files may have 8 blocks of 1 kB: the first image does not fit.
  const ProgramRun run = RunProgram("trap '' XFSZ; ulimit -f 8; " SIMULATE,
                                    "--preset fr3_static --humans 0 --seconds 0.1 --out " + out);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("cannot be written"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Simulate, LeavesNothingWhenTheBagDoesNotFit) {
  const TemporaryFolder folder;
  const std::string out = folder / "run";
  const std::string bag = folder / "run.bag";
  // Files may have 4000 blocks of at most 1 kB: images fit, a bag of three frames does not.
  const ProgramRun run =
      RunProgram("trap '' XFSZ; ulimit -f 4000; " SIMULATE,
                 "--preset fr3_static --humans 0 --seconds 0.1 --out " + out + " --bag " + bag);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_THAT(run.output, HasSubstr("run.bag: cannot be written"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace posefusion
