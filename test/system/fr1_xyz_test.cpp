// The real sequence with its bounds, as run_dataset --preset ef runs it.

#include <gtest/gtest.h>

#include "posefusion/common/package_files.h"
#include "posefusion/dataset/prefetched_source.h"
#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/evaluation/trajectory_evaluation.h"
#include "posefusion/pipeline/offline_run.h"
#include "test/support/test_data.h"

namespace posefusion {
namespace {

constexpr char kSequence[] = "fr1_xyz";
constexpr double kMaxAteM = 0.012;
constexpr double kMaxRpeMps = 0.022;
/// Every third frame: the same motion three times as fast.
constexpr double kMaxAteThinnedM = 0.015;

/// Leaves out all but every n-th frame of another source.
class ThinnedSource : public FrameSource {
 public:
  ThinnedSource(const std::string& folder, int keep_every)
      : source_(folder), keep_every_(keep_every) {}

  std::optional<RgbdFrame> Next() override {
    for (int i = 1; i < keep_every_; ++i) source_.Next();
    return source_.Next();
  }
  std::optional<int> NumFrames() const override { return *source_.NumFrames() / keep_every_; }

 private:
  TumFolderSource source_;
  int keep_every_;
};

OfflineRun RunEf(FrameSource& source, int num_threads) {
  const SystemConfig config = LoadSystemConfig({FindPackageFile("config/presets/ef.yaml")});
  return RunOffline(source, config, num_threads);
}

TEST(Fr1Xyz, IsTrackedWithinBoundsAndRepeatableForAnyNumberOfThreads) {
  SKIP_WITHOUT_DATA(kSequence);
  PrefetchedSource source(std::make_unique<TumFolderSource>(DataPath(kSequence)));
  const OfflineRun run = RunEf(source, 2);
  EXPECT_EQ(run.Count(FrameState::kTracked), 300);
  const Trajectory truth = ReadTrajectory(DataPath(kSequence) + "/groundtruth.txt");
  const auto evaluation = EvaluateTrajectory(truth, run.trajectory);
  EXPECT_LE(evaluation.absolute.translation_m.rmse, kMaxAteM);
  EXPECT_LE(evaluation.relative.translation_mps.rmse, kMaxRpeMps);

  TumFolderOptions options;
  options.max_frames = 40;
  TumFolderSource first(DataPath(kSequence), options);
  TumFolderSource second(DataPath(kSequence), options);
  const OfflineRun one_thread = RunEf(first, 1);
  const OfflineRun two_threads = RunEf(second, 2);
  ASSERT_EQ(one_thread.trajectory.size(), two_threads.trajectory.size());
  for (std::size_t i = 0; i < one_thread.trajectory.size(); ++i) {
    EXPECT_EQ(one_thread.trajectory[i].T_map_camera.matrix(),
              two_threads.trajectory[i].T_map_camera.matrix());
  }
  EXPECT_EQ(one_thread.map.position_m, two_threads.map.position_m);
}

TEST(Fr1Xyz, ThreeTimesAsFastIsStillTracked) {
  SKIP_WITHOUT_DATA(kSequence);
  ThinnedSource source(DataPath(kSequence), 3);
  const OfflineRun run = RunEf(source, 2);
  EXPECT_EQ(run.Count(FrameState::kTracked), 100);
  const auto evaluation =
      EvaluateTrajectory(ReadTrajectory(DataPath(kSequence) + "/groundtruth.txt"), run.trajectory);
  EXPECT_LE(evaluation.absolute.translation_m.rmse, kMaxAteThinnedM);
}

}  // namespace
}  // namespace posefusion
