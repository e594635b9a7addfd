#include "posefusion/pipeline/offline_run.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/skeleton/arrival_queue.h"
#include "test/support/rendered_source.h"

namespace posefusion {
namespace {

using testing::RenderedSource;

/// Poses as numbers, for comparing bit by bit.
std::vector<double> Numbers(const Trajectory& trajectory) {
  std::vector<double> numbers;
  for (const StampedPose& pose : trajectory) {
    const Eigen::Matrix4d& T = pose.T_map_camera.matrix();
    numbers.insert(numbers.end(), T.data(), T.data() + T.size());
  }
  return numbers;
}

OfflineRun RunRendered(int num_threads) {
  RenderedSource source(25);
  return RunOffline(source, SystemConfig(), num_threads);
}

/// Throws at the frames 3 and 4.
class DamagedSource : public RenderedSource {
 public:
  using RenderedSource::RenderedSource;
  std::optional<RgbdFrame> Next() override {
    auto frame = RenderedSource::Next();
    const int i = count_++;
    if (i == 3 || i == 4) throw std::runtime_error("frame.png: truncated");
    return frame;
  }

 private:
  int count_ = 0;
};

TEST(OfflineRun, SameBitsTwiceAndForAnyNumberOfThreads) {
  const OfflineRun first = RunRendered(1);
  ASSERT_EQ(first.trajectory.size(), 25U);
  for (const int num_threads : {1, 2, 4}) {
    const OfflineRun again = RunRendered(num_threads);
    EXPECT_EQ(Numbers(first.trajectory), Numbers(again.trajectory)) << num_threads;
    EXPECT_EQ(first.map.position_m, again.map.position_m) << num_threads;
    EXPECT_EQ(first.map.confidence, again.map.confidence) << num_threads;
  }
}

TEST(OfflineRun, RecordsEveryFrameAndStage) {
  const OfflineRun run = RunRendered(2);
  EXPECT_EQ(run.frames.size(), 25U);
  EXPECT_EQ(run.frame_ms.size(), 25U);
  EXPECT_EQ(run.Count(FrameState::kTracked) + run.Count(FrameState::kDroppedBlur), 25);
  for (const char* stage : {"blur", "rectify", "prepare", "track", "fuse", "predict"}) {
    EXPECT_EQ(run.stage_ms.count(stage), 1U) << stage;
  }
}

TEST(OfflineRun, ReportsUnreadableFramesAndGoesOn) {
  DamagedSource source(12);
  std::vector<std::string> heard;
  OfflineRunHooks hooks;
  hooks.on_error = [&](const std::string& text) { heard.push_back(text); };
  const OfflineRun run = RunOffline(source, SystemConfig(), 2, hooks);
  EXPECT_EQ(run.errors, (std::vector<std::string>{"frame.png: truncated", "frame.png: truncated"}));
  EXPECT_EQ(heard, run.errors);
  EXPECT_EQ(run.Count(FrameState::kTracked), 10);
}

TEST(OfflineRun, StopsWhenAskedAndKeepsWhatThereIs) {
  RenderedSource source(25);
  int done = 0;
  OfflineRunHooks hooks;
  hooks.on_frame = [&](int count) { done = count; };
  hooks.should_stop = [&] { return done >= 7; };
  const OfflineRun run = RunOffline(source, SystemConfig(), 2, hooks);
  EXPECT_EQ(run.trajectory.size(), 7U);
  EXPECT_GT(run.num_surfels, 0U);
}

/// Keypoints of every frame two frames late; those of the frame with index 3 are bad.
class LateSkeletons : public SkeletonSource {
 public:
  void Offer(const RgbdFrame& frame) override {
    const int index = num_offered_++;
    if (index == 3) throw std::runtime_error("3.json: malformed");
    const StampNs arrival_ns = frame.stamp_ns + 2 * testing::kRenderedInterval;
    waiting_.Add({frame.stamp_ns, SkeletonLayout::kCoco18, {}, arrival_ns});
  }
  std::vector<Skeletons> Take(StampNs now_ns) override { return waiting_.Take(now_ns); }
  std::vector<std::string> TakeNotes() override {
    return num_offered_ == 5 ? std::vector<std::string>{"note"} : std::vector<std::string>();
  }
  SkeletonCounts counts() const override { return {num_offered_, 0}; }

 private:
  ArrivalQueue waiting_;
  int num_offered_ = 0;
};

TEST(OfflineRun, TakesKeypointsAtTheirArrivalAndSurvivesBadOnes) {
  RenderedSource source(12);
  LateSkeletons skeletons;
  std::vector<std::string> notes;
  OfflineRunHooks hooks;
  hooks.on_note = [&](const std::string& text) { notes.push_back(text); };
  const OfflineRun run = RunOffline(source, SystemConfig(), 2, hooks, &skeletons);
  EXPECT_EQ(skeletons.counts().frames_with_keypoints, 12) << "every frame, also blurred ones";
  EXPECT_EQ(run.num_keypoints, 12 - 2 - 1);
  EXPECT_EQ(run.errors, std::vector<std::string>{"3.json: malformed"});
  EXPECT_EQ(run.num_bad_frames, 0);
  EXPECT_EQ(run.frames.size(), 12U);
  EXPECT_EQ(notes, std::vector<std::string>{"note"});
}

}  // namespace
}  // namespace posefusion
