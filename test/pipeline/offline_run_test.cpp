#include "posefusion/pipeline/offline_run.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/segmentation/human_remover.h"
#include "posefusion/skeleton/arrival_queue.h"
#include "test/segmentation/moving_person.h"
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

/// Somebody who walks, for ten frames.
class WalkingPerson : public FrameSource {
 public:
  std::optional<RgbdFrame> Next() override {
    if (index_ == kNumFrames) return std::nullopt;
    return MovingPerson().FrameAt(index_++);
  }
  std::optional<int> NumFrames() const override { return kNumFrames; }

 private:
  static constexpr int kNumFrames = 10;
  int index_ = 0;
};

/// The keypoints of the same, of the first frame only, five frames late.
class FirstSkeletonsLate : public SkeletonSource {
 public:
  void Offer(const RgbdFrame& frame) override {
    if (num_offered_++ > 0) return;
    Skeletons skeletons = MovingPerson().SkeletonsAt(0);
    skeletons.arrival_ns = frame.stamp_ns + 5 * kFrameIntervalNs;
    waiting_.Add(std::move(skeletons));
  }
  std::vector<Skeletons> Take(StampNs now_ns) override { return waiting_.Take(now_ns); }
  SkeletonCounts counts() const override { return {num_offered_, 0}; }

 private:
  ArrivalQueue waiting_;
  int num_offered_ = 0;
};

/// Whether each frame in the order of its work has somebody in its mask.
std::vector<bool> FramesWithPeople(const HumanRemovalConfig& human_removal) {
  WalkingPerson source;
  FirstSkeletonsLate skeletons;
  SystemConfig config;
  config.blur_filter.enabled = false;
  config.human_removal = human_removal;
  std::vector<bool> have_people;
  StampNs before_ns = -1;
  OfflineRunHooks hooks;
  hooks.on_mask = [&](StampNs stamp_ns, const cv::Mat& mask) {
    EXPECT_GT(stamp_ns, before_ns);
    before_ns = stamp_ns;
    have_people.push_back(cv::countNonZero(mask) > 0);
  };
  RunOffline(source, config, 1, hooks, &skeletons);
  return have_people;
}

TEST(OfflineRun, FirstFramesWaitForTheFirstKeypoints) {
  EXPECT_EQ(FramesWithPeople({}), std::vector<bool>(10, true));
}

TEST(OfflineRun, FramesThatWaitAreLeftOutWhenItIsStopped) {
  WalkingPerson source;
  FirstSkeletonsLate skeletons;
  int asked = 0;
  OfflineRunHooks hooks;
  hooks.should_stop = [&] { return ++asked > 4; };
  EXPECT_TRUE(RunOffline(source, SystemConfig(), 1, hooks, &skeletons).frames.empty());
}

TEST(OfflineRun, FirstFramesWaitNoLongerThanTheyMay) {
  std::vector<bool> late(10, true);
  std::fill(late.begin(), late.begin() + 5, false);
  HumanRemovalConfig config;
  config.max_start_wait_s = 0.1;
  EXPECT_EQ(FramesWithPeople(config), late);
  config.max_start_wait_s = 1;
  config.policy = KeypointPolicy::kPass;
  EXPECT_EQ(FramesWithPeople(config), std::vector<bool>(10, false));
}

/// Somebody seen by a camera that is rolled clockwise by 90 degrees, with joints down to the hips.
class RolledPerson : public FrameSource {
 public:
  static constexpr int kNumFrames = 4;

  static RgbdFrame FrameAt(int index) { return Rolled(MovingPerson().FrameAt(index)); }
  static Skeletons SkeletonsAt(int index) {
    Skeletons skeletons = MovingPerson().SkeletonsAt(index);
    for (Skeleton& person : skeletons.people) {
      for (const CocoJoint joint : {kRightKnee, kLeftKnee, kRightAnkle, kLeftAnkle}) {
        person[joint] = {};
      }
      person = Rolled(person, MovingPerson().SceneAt(index).camera);
    }
    return skeletons;
  }

  std::optional<RgbdFrame> Next() override {
    if (index_ == kNumFrames) return std::nullopt;
    return FrameAt(index_++);
  }
  std::optional<int> NumFrames() const override { return kNumFrames; }

 private:
  int index_ = 0;
};

/// The keypoints of the same, in time.
class RolledSkeletons : public SkeletonSource {
 public:
  void Offer(const RgbdFrame& /*frame*/) override { ++num_offered_; }
  std::vector<Skeletons> Take(StampNs /*now_ns*/) override {
    return {RolledPerson::SkeletonsAt(num_offered_ - 1)};
  }
  SkeletonCounts counts() const override { return {num_offered_, 0}; }

 private:
  int num_offered_ = 0;
};

/// A camera at rest whose image's right points downwards.
class RolledOdometry : public OdometrySource {
 public:
  std::optional<Eigen::Isometry3d> PoseAt(StampNs /*stamp_ns*/) const override {
    Eigen::Isometry3d T_odom_camera = Eigen::Isometry3d::Identity();
    T_odom_camera.linear() << 0, 0, 1, 0, 1, 0, -1, 0, 0;
    return T_odom_camera;
  }
};

std::vector<cv::Mat> MasksOfRolledPerson(const OdometrySource* odometry) {
  RolledPerson source;
  RolledSkeletons skeletons;
  std::vector<cv::Mat> masks;
  OfflineRunHooks hooks;
  hooks.on_mask = [&](StampNs, const cv::Mat& mask) { masks.push_back(mask); };
  SystemConfig config;
  config.blur_filter.enabled = false;
  RunOffline(source, config, 1, hooks, &skeletons, odometry);
  return masks;
}

TEST(OfflineRun, CutsPeopleWithTheGravityOfOdometry) {
  const RolledOdometry odometry;
  const std::vector<cv::Mat> masks = MasksOfRolledPerson(&odometry);
  const std::vector<cv::Mat> without = MasksOfRolledPerson(nullptr);
  ASSERT_EQ(masks.size(), RolledPerson::kNumFrames);
  ASSERT_EQ(without.size(), RolledPerson::kNumFrames);
  HumanRemover remover((HumanRemovalConfig()));
  for (int i = 0; i < RolledPerson::kNumFrames; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const cv::Mat expected = remover
                                 .Process(RolledPerson::FrameAt(i), {RolledPerson::SkeletonsAt(i)},
                                          Eigen::Vector3f::UnitX())
                                 .mask;
    EXPECT_EQ(cv::norm(masks[index], expected, cv::NORM_INF), 0) << i;
    EXPECT_GT(cv::norm(masks[index], without[index], cv::NORM_INF), 0) << i;
  }
}

}  // namespace
}  // namespace posefusion
