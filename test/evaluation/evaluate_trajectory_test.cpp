// The program evaluate_trajectory, run as its users run it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/trajectory_file.h"
#include "test/evaluation/sample_trajectories.h"
#include "test/support/program_run.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::HasSubstr;

ProgramRun RunEvaluation(const std::string& arguments) {
  return RunProgram(EVALUATE_TRAJECTORY, arguments);
}

class EvaluateTrajectoryTest : public testing::Test {
 protected:
  EvaluateTrajectoryTest() {
    WriteTrajectory(WavyTrajectory(100), folder_ / "truth.txt");
    WriteTrajectory(InOtherMap(WavyTrajectory(90), ExpSE3(Vector6d::Constant(0.5))),
                    folder_ / "estimate.txt");
  }

  std::string Files() const {
    return "--groundtruth " + (folder_ / "truth.txt") + " --estimate " + (folder_ / "estimate.txt");
  }

  TemporaryFolder folder_;
};

TEST_F(EvaluateTrajectoryTest, PrintsTheFiguresAndWritesAllFiles) {
  const ProgramRun run = RunEvaluation(Files() + " --out " + (folder_ / "a/b"));
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("ATE"));
  EXPECT_THAT(run.output, HasSubstr("coverage"));
  for (const char* name : {"evaluation.json", "evaluation_poses.csv", "evaluation_rpe.csv",
                           "trajectory_top.png", "trajectory_axes.png", "ate.png", "rpe.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / (std::string("a/b/") + name))) << name;
  }
}

TEST_F(EvaluateTrajectoryTest, ShortRunHasNoRelativeErrorButIsEvaluated) {
  WriteTrajectory(WavyTrajectory(10), folder_ / "estimate.txt");
  const ProgramRun run = RunEvaluation(Files() + " --out " + (folder_ / "out"));
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/ate.png")) << run.output;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/rpe.png"));
}

TEST_F(EvaluateTrajectoryTest, FailedPlotsAreOneWarning) {
  // A folder in the place of a picture.
  std::filesystem::create_directories(folder_ / "out/trajectory_top.png");
  const ProgramRun run = RunEvaluation(Files() + " --out " + (folder_ / "out"));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.output, HasSubstr("warning: no plots"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/evaluation.json"));
}

TEST_F(EvaluateTrajectoryTest, ErrorsHaveTheirExitCodes) {
  EXPECT_EQ(RunEvaluation("").exit_code, 2);
  EXPECT_EQ(RunEvaluation(Files() + " --unknown").exit_code, 2);
  EXPECT_EQ(RunEvaluation("--help").exit_code, 0);
  const ProgramRun missing = RunEvaluation("--groundtruth /nowhere.txt --estimate /nowhere.txt");
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.output, HasSubstr("/nowhere.txt: cannot be read"));
  const ProgramRun unwritable = RunEvaluation(Files() + " --out /proc/nowhere");
  EXPECT_EQ(unwritable.exit_code, 1);
  EXPECT_THAT(unwritable.output, HasSubstr("/proc/nowhere"));
}

}  // namespace
}  // namespace posefusion
