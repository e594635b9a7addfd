#include "posefusion/evaluation/trajectory_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/evaluation/evaluation_report.h"
#include "test/evaluation/sample_trajectories.h"
#include "test/support/temporary_folder.h"
#include "test/support/test_data.h"

namespace posefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// Results of other systems whose ATE an independent script has computed to four decimals.
struct KnownResult {
  const char* sequence;
  const char* estimate;
  std::size_t num_pairs;
  double ate_m;
};
const KnownResult kKnownResults[] = {
    {"walking_static", "Horacehxw_Dynamic_ORB_SLAM2__w_static_Dyna0", 714, 0.0132},
    {"walking_static", "Horacehxw_Dynamic_ORB_SLAM2__w_static_ORB", 714, 0.3789},
    {"walking_xyz", "Horacehxw_Dynamic_ORB_SLAM2__w_xyz_Dyna0", 826, 0.0154},
    {"walking_xyz", "nanoshimarobot_DS-SLAM__fr3_walk_xyz_CameraTrajectory_0", 826, 0.1328},
    {"walking_xyz", "RaymondFist_semantic-slam-yolov8__baseline_tum_xyz", 826, 0.5837},
    {"walking_halfsphere", "RaymondFist_semantic-slam-yolov8__mask_tum_walking_half", 1017, 0.0378},
    {"walking_rpy", "guanfang12_dyslam__w_rpy_yolact_1", 682, 0.0380}};
constexpr double kHalfDigitM = 0.00005;

EvaluationFiles FilesOf(const KnownResult& known) {
  const std::string root = DataPath("trajectories");
  return {root + "/groundtruth/fr3_" + known.sequence + ".txt",
          root + "/estimated/" + known.estimate + ".txt", "", ""};
}

TEST(TrajectoryEvaluation, AgreesWithKnownResultsToTheLastDigit) {
  SKIP_WITHOUT_DATA("trajectories");
  for (const KnownResult& known : kKnownResults) {
    const TrajectoryEvaluation result = EvaluateFiles(FilesOf(known));
    EXPECT_EQ(result.absolute.pairs.size(), known.num_pairs) << known.estimate;
    EXPECT_NEAR(result.absolute.translation_m.rmse, known.ate_m, kHalfDigitM) << known.estimate;
  }
}

TEST(TrajectoryEvaluation, AgreesWithTheRelativeErrorOfTheTumScript) {
  SKIP_WITHOUT_DATA("trajectories");
  // From a separate numpy implementation of evaluate_rpe --fixed_delta on the same files.
  const TrajectoryEvaluation result = EvaluateFiles(FilesOf(kKnownResults[2]));
  EXPECT_EQ(result.relative.samples.size(), 797U);
  EXPECT_NEAR(result.relative.translation_mps.rmse, 0.019365, 5e-7);
  EXPECT_NEAR(result.relative.translation_mps.median, 0.014865, 5e-7);
  EXPECT_NEAR(result.relative.rotation_degps.rmse, 0.602667, 5e-7);
}

/// Truth and estimate as files, the last ten of a hundred frames lost.
class EvaluationFilesTest : public testing::Test {
 protected:
  EvaluationFilesTest() {
    const Trajectory truth = WavyTrajectory(100);
    WriteTrajectory(truth, files_.groundtruth);
    WriteTrajectory(Trajectory(truth.begin(), truth.begin() + 90), files_.estimate);
  }

  TemporaryFolder folder_;
  EvaluationFiles files_{folder_ / "truth.txt", folder_ / "trajectory.txt", "", ""};
};

TEST_F(EvaluationFilesTest, CoverageTakesTheBestBasis) {
  EXPECT_EQ(EvaluateFiles(files_).coverage.basis, CoverageBasis::kTruth);
  WriteFileAtomically(folder_ / "report.json", R"({"frames": {"total": 100, "dropped_blur": 4}})");
  EXPECT_EQ(EvaluateFiles(files_).coverage.basis, CoverageBasis::kReport);
  EXPECT_DOUBLE_EQ(EvaluateFiles(files_).coverage.Ratio(), 90.0 / 96);
  std::string frames;
  for (const StampedPose& pose : WavyTrajectory(100)) frames += FormatStamp(pose.stamp_ns) + "\n";
  WriteFileAtomically(folder_ / "frames.txt", frames);
  EXPECT_EQ(EvaluateFiles(files_).coverage.basis, CoverageBasis::kFrames);
  EXPECT_DOUBLE_EQ(EvaluateFiles(files_).coverage.Ratio(), 0.9);
}

TEST_F(EvaluationFilesTest, CountsAreNotUsedWithExcludedIntervals) {
  WriteFileAtomically(folder_ / "report.json", R"({"frames": {"total": 100, "dropped_blur": 0}})");
  WriteFileAtomically(folder_ / "events.txt", "1000.5 1001.0 fall\n");
  files_.exclude = folder_ / "events.txt";
  EXPECT_EQ(EvaluateFiles(files_).coverage.basis, CoverageBasis::kTruth);
}

TEST_F(EvaluationFilesTest, ErrorsNameTheFiles) {
  WriteTrajectory(WavyTrajectory(2), files_.estimate);
  EXPECT_THAT([&] { EvaluateFiles(files_); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr(files_.estimate), HasSubstr("only 2 poses"))));
  files_.groundtruth = "/nowhere/truth.txt";
  EXPECT_THAT([&] { EvaluateFiles(files_); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/nowhere/truth.txt")));
}

TEST_F(EvaluationFilesTest, ReportHasUnitsInItsKeys) {
  const nlohmann::json json = ToJson(EvaluateFiles(files_));
  EXPECT_LT(json.at("ate").at("translation").at("rmse_m").get<double>(), 1e-6);
  EXPECT_TRUE(json.at("ate").at("rotation").contains("max_deg"));
  EXPECT_TRUE(json.at("rpe").at("translation").contains("rmse_mps"));
  EXPECT_TRUE(json.at("rpe").at("rotation").contains("median_degps"));
  EXPECT_EQ(json.at("coverage").at("basis"), "truth");
}

}  // namespace
}  // namespace posefusion
