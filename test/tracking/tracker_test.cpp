#include "posefusion/tracking/tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <opencv2/core.hpp>

#include "posefusion/surfel/fusion.h"
#include "posefusion/surfel/splatter.h"
#include "test/support/rendered_room.h"

namespace posefusion {
namespace {

using testing::LookAlong;
using testing::RenderedRoom;

constexpr StampNs kFrameInterval = 33'000'000;
/// What noiseless frames of 160x120 against a map of one pixel in four must reach.
constexpr double kMaxTranslationError = 0.003;
constexpr double kMaxRotationError = 0.003;

/// A map made at a known pose, and a tracker started there.
class TrackerTest : public ::testing::Test {
 protected:
  void Start(const RenderedRoom& room, const Eigen::Isometry3d& pose,
             const TrackingConfig& config = SmallImages()) {
    tracker_ = std::make_unique<Tracker>(config, noise_);
    SurfelMap map{SurfelMapConfig()};
    Fuser fuser(FusionConfig(), noise_);
    for (int i = 0; i < 3; ++i) {
      Prepare(room, pose);
      fuser.Fuse(pyramid_, {pose, pose}, 1, parallel_, map);
    }
    tracker_->Start(pyramid_, pose);
    SplatConfig splat;
    splat.level = 0;
    Splatter(splat, noise_).Render(map, testing::SmallCamera(), pose, 0, parallel_, view_);
    BuildIntensityLevels(4, parallel_, view_);
  }

  /// The frames are small, so the coarsest levels would be tiny.
  static TrackingConfig SmallImages() {
    TrackingConfig config;
    config.coarsest_level = 2;
    config.finest_level = 0;
    config.so3.level = 1;
    return config;
  }

  void Prepare(const RenderedRoom& room, const Eigen::Isometry3d& pose,
               const cv::Mat& mask = cv::Mat()) {
    stamp_ns_ += kFrameInterval;
    builder_.Build(room.Render(testing::SmallCamera(), pose, stamp_ns_), {mask, {}}, parallel_,
                   pyramid_);
  }

  TrackingResult Track(const RenderedRoom& room, const Eigen::Isometry3d& pose,
                       const cv::Mat& mask = cv::Mat()) {
    Prepare(room, pose, mask);
    return tracker_->Track(pyramid_, view_, parallel_);
  }

  /// A prior that is certain to a centimetre and a hundredth of a radian.
  static MotionPrior PriorOf(const Vector6d& motion) {
    MotionPrior prior;
    prior.T_last_camera = ExpSE3(motion);
    prior.covariance = 1e-4 * Matrix6d::Identity();
    return prior;
  }

  static void ExpectPose(const TrackingResult& result, const Eigen::Isometry3d& pose) {
    const Vector6d error = LogSE3(pose.inverse() * result.T_map_camera);
    EXPECT_EQ(result.health, TrackingHealth::kGood) << result.failure;
    EXPECT_LT(error.head<3>().norm(), kMaxTranslationError);
    EXPECT_LT(error.tail<3>().norm(), kMaxRotationError);
  }

  DepthNoiseConfig noise_;
  ParallelRunner parallel_{2};
  PyramidBuilder builder_{PyramidConfig(), noise_};
  FramePyramid pyramid_;
  ModelView view_;
  std::unique_ptr<Tracker> tracker_;
  StampNs stamp_ns_ = 0;
};

const Eigen::Isometry3d kStart = LookAlong({-1, 0, 0.2}, 0.2, 0.3);

Eigen::Isometry3d Moved(const Vector6d& twist) { return kStart * ExpSE3(twist); }

TEST_F(TrackerTest, RecoversSmallMotionsInEveryDirection) {
  for (int axis = 0; axis < 6; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      Vector6d twist = Vector6d::Zero();
      twist[axis] = sign * 0.03;
      Start(RenderedRoom::Furnished(), kStart);
      ExpectPose(Track(RenderedRoom::Furnished(), Moved(twist)), Moved(twist));
    }
  }
}

TEST_F(TrackerTest, RecoversAFastTurn) {
  // 6 degrees a frame are 180 degrees a second.
  const Vector6d twist = (Vector6d() << 0.01, 0.01, 0, 0.02, 0.1, 0.03).finished();
  Start(RenderedRoom::Furnished(), kStart);
  ExpectPose(Track(RenderedRoom::Furnished(), Moved(twist)), Moved(twist));
}

TEST_F(TrackerTest, SteadyMotionIsFollowedOverDroppedFrames) {
  TrackingConfig config = SmallImages();
  config.so3.enabled = false;  // it would find the turn by itself
  const RenderedRoom room = RenderedRoom::Furnished();
  const Vector6d step = (Vector6d() << 0, 0, 0, 0.01, 0.055, 0).finished();
  Start(room, kStart, config);
  for (int i = 1; i <= 2; ++i) ExpectPose(Track(room, Moved(i * step)), Moved(i * step));
  constexpr int kDropped = 3;
  stamp_ns_ += kDropped * kFrameInterval;
  const Vector6d moved = (2 + kDropped + 1) * step;
  ExpectPose(Track(room, Moved(moved)), Moved(moved));
}

TEST_F(TrackerTest, EachKindOfResidualWorksAlone) {
  const Vector6d twist = (Vector6d() << 0.01, -0.02, 0.01, 0.01, 0.01, -0.02).finished();
  for (const bool icp : {true, false}) {
    TrackingConfig config = SmallImages();
    config.use_icp = icp;
    config.use_intensity = !icp;
    Start(RenderedRoom::Furnished(), kStart, config);
    ExpectPose(Track(RenderedRoom::Furnished(), Moved(twist)), Moved(twist));
  }
}

TEST_F(TrackerTest, MovingTheWholeWorldMovesTheResult) {
  const Vector6d twist = (Vector6d() << 0.02, 0.01, -0.01, 0.01, -0.02, 0.01).finished();
  Start(RenderedRoom::Furnished(), kStart);
  const TrackingResult here = Track(RenderedRoom::Furnished(), Moved(twist));
  Start(RenderedRoom::Furnished(), kStart);
  const Eigen::Isometry3d T_new_old = ExpSE3((Vector6d() << 5, -3, 1, 0.3, -0.4, 2).finished());
  view_.T_map_camera = T_new_old * view_.T_map_camera;
  Tracker moved(SmallImages(), noise_);
  moved.Start(pyramid_, view_.T_map_camera);
  Prepare(RenderedRoom::Furnished(), Moved(twist));
  const TrackingResult there = moved.Track(pyramid_, view_, parallel_);
  const Eigen::Isometry3d difference =
      (T_new_old * here.T_map_camera).inverse() * there.T_map_camera;
  EXPECT_LT(LogSE3(difference).norm(), 1e-6);
}

TEST_F(TrackerTest, MaskedPixelsDoNotPull) {
  RenderedRoom visited = RenderedRoom::Furnished();
  visited.AddBox({{-0.4, -0.3, -1}, {-0.2, 0.25, 0.3}});
  const Vector6d twist = (Vector6d() << 0.02, 0, 0.01, 0, 0.02, 0).finished();
  const RgbdFrame without =
      RenderedRoom::Furnished().Render(testing::SmallCamera(), Moved(twist), 0);
  const RgbdFrame with = visited.Render(testing::SmallCamera(), Moved(twist), 0);
  cv::Mat mask(with.depth_m.size(), CV_8UC1, cv::Scalar::all(0));
  mask.setTo(255, with.depth_m != without.depth_m);
  ASSERT_GT(cv::countNonZero(mask), 2000);
  Start(RenderedRoom::Furnished(), kStart);
  ExpectPose(Track(visited, Moved(twist), mask), Moved(twist));
}

TEST_F(TrackerTest, NoDepthFailsAndTheNextFrameGoesOnFromTheLastGoodPose) {
  Start(RenderedRoom::Furnished(), kStart);
  const cv::Mat everything(120, 160, CV_8UC1, cv::Scalar::all(255));
  const TrackingResult blind = Track(RenderedRoom::Furnished(), kStart, everything);
  EXPECT_EQ(blind.health, TrackingHealth::kFailed);
  EXPECT_STREQ(blind.failure, "too little depth");
  ExpectPose(Track(RenderedRoom::Furnished(), kStart), kStart);
}

/// Somebody unmasked has pulled the pose away: what still fits lies centimetres off the map, while
/// the intensities look well.
TEST_F(TrackerTest, DistancesThatFitMuchWorseThanBeforeAreRefused) {
  const RenderedRoom room = RenderedRoom::Furnished();
  Start(room, kStart);
  for (int i = 0; i < 6; ++i) ExpectPose(Track(room, kStart), kStart);
  stamp_ns_ += kFrameInterval;
  RgbdFrame frame = room.Render(testing::SmallCamera(), kStart, stamp_ns_);
  for (int y = 0; y < frame.depth_m.rows; ++y) {
    for (int x = 0; x < frame.depth_m.cols; ++x) {
      const bool is_somebody = x < frame.depth_m.cols / 2;
      const float off_m = (x / 16 + y / 16) % 2 == 0 ? 0.04F : -0.04F;
      frame.depth_m.at<float>(y, x) += is_somebody ? -0.6F : off_m;
    }
  }
  builder_.Build(frame, {}, parallel_, pyramid_);
  const TrackingResult result = tracker_->Track(pyramid_, view_, parallel_);
  EXPECT_EQ(result.health, TrackingHealth::kFailed) << result.icp_sigmas;
  EXPECT_STREQ(result.failure, "fits much worse than before");
}

TEST_F(TrackerTest, AnotherPlaceIsNotMistakenForTheMap) {
  Start(RenderedRoom::Furnished(), kStart);
  const TrackingResult lost =
      Track(RenderedRoom::Furnished(), LookAlong({1.2, 1.6, 0.5}, M_PI, 0.1));
  EXPECT_EQ(lost.health, TrackingHealth::kFailed);
  EXPECT_TRUE(tracker_->T_map_camera().isApprox(kStart));
}

TEST_F(TrackerTest, AWallWithoutTextureIsWeakOrFailed) {
  RenderedRoom wall = RenderedRoom::Wall(1.5);
  wall.SetTextured(false);
  const auto pose = LookAlong({0, 0, 0}, 0, 0);
  Start(wall, pose);
  const TrackingResult result = Track(wall, pose);
  EXPECT_NE(result.health, TrackingHealth::kGood) << result.covariance;
}

TEST_F(TrackerTest, UncertainPosesAreRefusedAfterAGapOnly) {
  TrackingConfig config = SmallImages();
  config.weak_sigma_m = 1e-5;  // every pose is
  const RenderedRoom room = RenderedRoom::Furnished();
  Start(room, kStart, config);
  EXPECT_EQ(Track(room, kStart).health, TrackingHealth::kWeak);
  stamp_ns_ += StampFromSeconds(config.gap_s);
  const TrackingResult late = Track(room, kStart);
  EXPECT_EQ(late.health, TrackingHealth::kFailed);
  EXPECT_STREQ(late.failure, "pose too uncertain");
}

TEST_F(TrackerTest, CovarianceIsLargestAlongAFeaturelessWall) {
  TrackingConfig config = SmallImages();
  config.use_intensity = false;
  const RenderedRoom wall = RenderedRoom::Wall(1.5);
  const auto pose = LookAlong({0, 0, 0}, 0.1, 0.1);
  Start(wall, pose, config);
  const TrackingResult result = Track(wall, pose);
  if (result.health == TrackingHealth::kFailed) GTEST_SUCCEED();
  EXPECT_GT(result.covariance(1, 1), 100 * result.covariance(0, 0));  // sideways against forward
}

TEST_F(TrackerTest, CovarianceIsSymmetricAndPositive) {
  Start(RenderedRoom::Furnished(), kStart);
  const Matrix6d covariance = Track(RenderedRoom::Furnished(), kStart).covariance;
  EXPECT_LT((covariance - covariance.transpose()).norm(), 1e-12);
  EXPECT_GT(covariance.diagonal().minCoeff(), 0);
}

TEST_F(TrackerTest, BrightnessMayChange) {
  Start(RenderedRoom::Furnished(), kStart);
  const Vector6d twist = (Vector6d() << 0.02, 0.01, 0, 0.01, 0.01, 0).finished();
  RgbdFrame frame = RenderedRoom::Furnished().Render(testing::SmallCamera(), Moved(twist), 1 << 30);
  frame.rgb.convertTo(frame.rgb, -1, 1.0, 15);
  builder_.Build(frame, {}, parallel_, pyramid_);
  ExpectPose(tracker_->Track(pyramid_, view_, parallel_), Moved(twist));
}

TEST_F(TrackerTest, AWrongPriorChangesNoBit) {
  const RenderedRoom room = RenderedRoom::Furnished();
  const Vector6d twist = (Vector6d() << 0.02, 0.01, 0, 0.01, 0.01, 0).finished();
  Start(room, kStart);
  const Eigen::Isometry3d without = Track(room, Moved(twist)).T_map_camera;
  Start(room, kStart);
  const Vector6d wrong = twist + (Vector6d() << 0.2, 0, 0, 0, 0, 0).finished();
  Prepare(room, Moved(twist));
  const TrackingResult with = tracker_->Track(pyramid_, view_, parallel_, PriorOf(wrong));
  EXPECT_EQ(with.prior, PriorUse::kContradicted);
  EXPECT_EQ(with.T_map_camera.matrix(), without.matrix());
  EXPECT_FALSE(tracker_->TrustsPriors());
}

TEST_F(TrackerTest, PriorsAreUsedAgainAfterEnoughThatAgree) {
  const RenderedRoom room = RenderedRoom::Furnished();
  TrackingConfig config = SmallImages();
  config.prior.regain_frames = 2;
  Start(room, kStart, config);
  std::vector<PriorUse> uses;
  for (const double error_m : {0.0, 0.3, 0.0, 0.0, 0.0}) {
    Prepare(room, kStart);
    const Vector6d motion = (Vector6d() << error_m, 0, 0, 0, 0, 0).finished();
    uses.push_back(tracker_->Track(pyramid_, view_, parallel_, PriorOf(motion)).prior);
  }
  EXPECT_EQ(uses,
            (std::vector<PriorUse>{PriorUse::kUsed, PriorUse::kContradicted, PriorUse::kDistrusted,
                                   PriorUse::kDistrusted, PriorUse::kUsed}));
}

TEST_F(TrackerTest, ThePriorDecidesWhereTheImagesSayNothing) {
  RenderedRoom wall = RenderedRoom::Wall(1.5);
  wall.SetTextured(false);
  const auto pose = LookAlong({0, 0, 0}, 0, 0);
  const Vector6d sideways = (Vector6d() << 0.03, 0, 0, 0, 0, 0).finished();
  Start(wall, pose);
  Prepare(wall, pose * ExpSE3(sideways));
  const TrackingResult result = tracker_->Track(pyramid_, view_, parallel_, PriorOf(sideways));
  ASSERT_NE(result.health, TrackingHealth::kFailed) << result.failure;
  EXPECT_EQ(result.prior, PriorUse::kUsed);
  const Vector6d error = LogSE3((pose * ExpSE3(sideways)).inverse() * result.T_map_camera);
  EXPECT_LT(error.head<3>().norm(), kMaxTranslationError);
  EXPECT_NEAR(std::sqrt(result.covariance(1, 1)), 0.01, 0.001) << "as uncertain as the prior";
}

TEST_F(TrackerTest, WhatPriorsAloneSayGetsLessCertainWithEveryFrame) {
  RenderedRoom wall = RenderedRoom::Wall(1.5);
  wall.SetTextured(false);
  const auto pose = LookAlong({0, 0, 0}, 0, 0);
  Start(wall, pose);
  double variance_m2 = 0;
  for (int i = 1; i <= 3; ++i) {
    Prepare(wall, pose);
    const TrackingResult result =
        tracker_->Track(pyramid_, view_, parallel_, PriorOf(Vector6d::Zero()));
    EXPECT_GT(result.covariance(1, 1), variance_m2 + 0.5e-4) << i;
    variance_m2 = result.covariance(1, 1);
  }
}

}  // namespace
}  // namespace posefusion
