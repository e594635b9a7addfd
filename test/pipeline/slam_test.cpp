#include "posefusion/pipeline/slam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <vector>

#include "test/support/rendered_source.h"

namespace posefusion {
namespace {

using testing::RenderedSource;
using testing::SwayingPose;

constexpr int kTwoThreads = 2;

/// Error of the motion since the first frame.
double TranslationError(const Trajectory& trajectory, int i) {
  const Eigen::Isometry3d truth = SwayingPose(0).inverse() * SwayingPose(i);
  const Eigen::Isometry3d estimate = trajectory.front().T_map_camera.inverse() *
                                     trajectory[static_cast<std::size_t>(i)].T_map_camera;
  return (truth.translation() - estimate.translation()).norm();
}

RgbdFrame WithoutDepth(RgbdFrame frame) {
  frame.depth_m = cv::Mat(frame.depth_m.size(), CV_32FC1, cv::Scalar::all(0));
  return frame;
}

TEST(Slam, FollowsARenderedWalk) {
  Slam slam(SlamConfig(), kTwoThreads);
  RenderedSource source(60);
  while (const auto frame = source.Next()) {
    EXPECT_TRUE(slam.ProcessFrame(*frame).HasPose());
  }
  ASSERT_EQ(slam.trajectory().size(), 60U);
  for (int i = 0; i < 60; ++i) EXPECT_LT(TranslationError(slam.trajectory(), i), 0.01) << i;
}

TEST(Slam, StartsLevelAtTheOrigin) {
  Slam slam(SlamConfig(), kTwoThreads);
  const FrameResult first = slam.ProcessFrame(*RenderedSource(1).Next());
  EXPECT_EQ(first.tracking.health, TrackingHealth::kInitialized);
  EXPECT_TRUE(first.tracking.T_map_camera.translation().isZero());
  // The camera looks along x, its image's down is the map's minus z.
  EXPECT_TRUE((first.tracking.T_map_camera.linear() * Eigen::Vector3d::UnitZ())
                  .isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE((first.tracking.T_map_camera.linear() * Eigen::Vector3d::UnitY())
                  .isApprox(-Eigen::Vector3d::UnitZ()));
}

TEST(Slam, StartsAtTheGivenPoseAndAgainAfterAReset) {
  Eigen::Isometry3d start(Eigen::Translation3d(1, -2, 1.5));
  start.linear() = SwayingPose(5).linear();
  Slam slam(SlamConfig(), kTwoThreads);
  slam.SetStartPose(start);
  RenderedSource source(3);
  EXPECT_TRUE(slam.ProcessFrame(*source.Next()).tracking.T_map_camera.isApprox(start));
  EXPECT_TRUE(slam.ProcessFrame(*source.Next()).HasPose());
  EXPECT_LT(TranslationError(slam.trajectory(), 1), 0.01);
  slam.Reset();
  EXPECT_TRUE(slam.ProcessFrame(*source.Next()).tracking.T_map_camera.isApprox(start));
}

TEST(Slam, AdoptsTheDepthCutOffWhileItRuns) {
  Slam slam(SlamConfig(), kTwoThreads);
  RenderedSource source(3);
  slam.ProcessFrame(*source.Next());
  SlamConfig near;
  near.pyramid.max_depth_m = 0.5;  // nothing of the room is that near
  near.tracking.min_valid_ratio = 1;
  slam.Adopt(near);
  EXPECT_FALSE(slam.ProcessFrame(*source.Next()).HasPose());
  EXPECT_EQ(slam.config().tracking.min_valid_ratio, SlamConfig().tracking.min_valid_ratio);
  SlamConfig impossible;
  impossible.pyramid.max_depth_m = -1;
  EXPECT_THROW(slam.Adopt(impossible), std::invalid_argument);
  slam.Adopt(SlamConfig());
  EXPECT_TRUE(slam.ProcessFrame(*source.Next()).HasPose());
}

TEST(Slam, FramesWithoutDepthAreLostAndTheNextIsFound) {
  Slam slam(SlamConfig(), kTwoThreads);
  RenderedSource source(20);
  for (int i = 0; i < 20; ++i) {
    const RgbdFrame frame = *source.Next();
    const bool blind = i >= 8 && i < 12;
    const std::size_t surfels = slam.NumSurfels();
    const FrameResult result = slam.ProcessFrame(blind ? WithoutDepth(frame) : frame);
    EXPECT_EQ(result.HasPose(), !blind) << i;
    EXPECT_EQ(result.fused, !blind);
    if (blind) {
      EXPECT_EQ(slam.NumSurfels(), surfels);
    }
  }
  EXPECT_EQ(slam.trajectory().size(), 16U);
}

TEST(Slam, ALeapIsFoundOrLostButNeverMistaken) {
  const testing::RenderedRoom room = testing::RenderedRoom::Furnished();
  for (const double leap_m : {0.2, 0.35, 0.5, 0.8}) {
    for (const double turn_rad : {-0.5, 0.0, 0.3}) {
      Slam slam(SlamConfig(), kTwoThreads);
      RenderedSource source(15);
      while (const auto frame = source.Next()) slam.ProcessFrame(*frame);
      const Eigen::Isometry3d T_leap =
          SwayingPose(14) *
          ExpSE3((Vector6d() << leap_m, 0, 0.3 * leap_m, 0, turn_rad, 0).finished());
      const FrameResult result =
          slam.ProcessFrame(room.Render(testing::SmallCamera(), T_leap, 5'000'000'000));
      if (!result.HasPose()) continue;
      const Eigen::Isometry3d truth = SwayingPose(0).inverse() * T_leap;
      const Eigen::Isometry3d estimate =
          slam.trajectory().front().T_map_camera.inverse() * result.tracking.T_map_camera;
      EXPECT_LT((truth.translation() - estimate.translation()).norm(), 0.03)
          << leap_m << " m, " << turn_rad << " rad";
    }
  }
}

/// Small images: what is level 3 of 640x480 is level 1 of 160x120.
SlamConfig WithRelocalisation(bool enabled = true) {
  SlamConfig config;
  config.relocalisation.enabled = enabled;
  config.relocalisation.ferns.level = 1;
  return config;
}

/// Maps a part of the room, loses the camera for a second, and gives it back at `T_map_return`.
class CoveredCamera {
 public:
  static constexpr int kNumReturned = 15;

  std::vector<FrameResult> Run(Slam& slam, const Eigen::Isometry3d& T_map_return) {
    for (int i = 0; i < 60; ++i) EXPECT_TRUE(slam.ProcessFrame(Frame(Sweep(i))).HasPose()) << i;
    for (int i = 0; i < 30; ++i) {
      EXPECT_FALSE(slam.ProcessFrame(WithoutDepth(Frame(Sweep(60)))).HasPose()) << i;
    }
    std::vector<FrameResult> results;
    for (int i = 0; i < kNumReturned; ++i) {
      results.push_back(slam.ProcessFrame(Frame(T_map_return)));
    }
    return results;
  }

  /// There and back again through a part of the room.
  static Eigen::Isometry3d Sweep(int i) {
    const double s = std::sin(i * 0.105);
    return testing::LookAlong({-1.2 + 0.005 * i, 0.3 * s, 0.2}, 0.35 * s, 0.3);
  }

  static double ErrorM(const Slam& slam, const Eigen::Isometry3d& T_estimate,
                       const Eigen::Isometry3d& T_map_camera) {
    const Eigen::Isometry3d truth = Sweep(0).inverse() * T_map_camera;
    const Eigen::Isometry3d estimate =
        slam.trajectory().front().T_map_camera.inverse() * T_estimate;
    return (truth.translation() - estimate.translation()).norm();
  }

 private:
  RgbdFrame Frame(const Eigen::Isometry3d& T_map_camera) {
    stamp_ns_ += testing::kRenderedInterval;
    return room_.Render(testing::SmallCamera(), T_map_camera, stamp_ns_);
  }

  testing::RenderedRoom room_ = testing::RenderedRoom::Furnished();
  StampNs stamp_ns_ = 0;
};

/// 40 cm and 15 degrees from where the view was lost.
const Eigen::Isometry3d kReturn = testing::LookAlong({-0.95, -0.4, 0.2}, -0.27, 0.3);

TEST(Slam, FindsACameraAgainThatMovedOnWhileItWasCovered) {
  Slam slam(WithRelocalisation(), kTwoThreads);
  const std::vector<FrameResult> results = CoveredCamera().Run(slam, kReturn);
  int first = 0;
  while (first < CoveredCamera::kNumReturned && !results[static_cast<std::size_t>(first)].HasPose())
    ++first;
  ASSERT_LE(first, 5);
  EXPECT_TRUE(results[static_cast<std::size_t>(first)].relocalised);
  EXPECT_FALSE(results[static_cast<std::size_t>(first)].fused);
  for (auto i = static_cast<std::size_t>(first); i < results.size(); ++i) {
    ASSERT_TRUE(results[i].HasPose()) << i;
    EXPECT_LT(CoveredCamera::ErrorM(slam, results[i].tracking.T_map_camera, kReturn), 0.01) << i;
  }
  EXPECT_TRUE(results.back().fused);
}

TEST(Slam, StaysLostWithoutRelocalisation) {
  Slam slam(WithRelocalisation(false), kTwoThreads);
  EXPECT_FALSE(CoveredCamera().Run(slam, kReturn).back().HasPose());
}

TEST(Slam, NeverFindsTheCameraWhereItHasNotBeen) {
  for (const double yaw_rad : {3.1, 2.2, -2.4}) {
    Slam slam(WithRelocalisation(), kTwoThreads);
    const auto results =
        CoveredCamera().Run(slam, testing::LookAlong({-0.9, 0, 0.2}, yaw_rad, 0.3));
    for (const FrameResult& result : results) EXPECT_FALSE(result.HasPose()) << yaw_rad;
  }
}

TEST(Slam, RelocalisesTheSameWithAnyNumberOfThreads) {
  Slam one(WithRelocalisation(), 1);
  Slam two(WithRelocalisation(), kTwoThreads);
  const auto results_one = CoveredCamera().Run(one, kReturn);
  const auto results_two = CoveredCamera().Run(two, kReturn);
  for (std::size_t i = 0; i < results_one.size(); ++i) {
    EXPECT_EQ(results_one[i].relocalised, results_two[i].relocalised);
    EXPECT_TRUE(results_one[i].tracking.T_map_camera.matrix() ==
                results_two[i].tracking.T_map_camera.matrix());
  }
  EXPECT_EQ(one.NumSurfels(), two.NumSurfels());
}

TEST(Slam, WaitsForTheFirstFrameWithDepth) {
  Slam slam(SlamConfig(), kTwoThreads);
  RenderedSource source(4);
  EXPECT_FALSE(slam.ProcessFrame(WithoutDepth(*source.Next())).HasPose());
  EXPECT_FALSE(slam.ProcessFrame(WithoutDepth(*source.Next())).HasPose());
  EXPECT_EQ(slam.ProcessFrame(*source.Next()).tracking.health, TrackingHealth::kInitialized);
  EXPECT_EQ(slam.ProcessFrame(*source.Next()).tracking.health, TrackingHealth::kGood);
}

TEST(Slam, NotANumberAndInfiniteDepthAreNoDepth) {
  Slam slam(SlamConfig(), kTwoThreads);
  RenderedSource source(10);
  while (auto frame = source.Next()) {
    for (int x = 0; x < 160; x += 3) {
      frame->depth_m.at<float>(50, x) = std::numeric_limits<float>::quiet_NaN();
      frame->depth_m.at<float>(51, x) = std::numeric_limits<float>::infinity();
      frame->depth_m.at<float>(52, x) = -1;
    }
    const FrameResult result = slam.ProcessFrame(*frame);
    EXPECT_TRUE(result.HasPose());
    EXPECT_TRUE(result.tracking.T_map_camera.matrix().allFinite());
  }
  for (const Eigen::Vector3f& p : slam.ExportMap(0).position_m) EXPECT_TRUE(p.allFinite());
}

TEST(Slam, RefusesFramesThatDoNotFit) {
  Slam slam(SlamConfig(), kTwoThreads);
  RenderedSource source(3);
  const RgbdFrame first = *source.Next();
  const RgbdFrame second = *source.Next();
  slam.ProcessFrame(second);
  EXPECT_THROW(slam.ProcessFrame(first), std::invalid_argument);   // backwards
  EXPECT_THROW(slam.ProcessFrame(second), std::invalid_argument);  // twice
  RgbdFrame third = *source.Next();
  const RgbdFrame good = third;
  third.depth_m = third.depth_m(cv::Rect(0, 0, 80, 60)).clone();
  EXPECT_THROW(slam.ProcessFrame(third), std::invalid_argument);
  third = good;
  third.camera.fx += 1;
  EXPECT_THROW(slam.ProcessFrame(third), std::invalid_argument);
  EXPECT_THROW(slam.ProcessFrame(good, PeopleInFrame{cv::Mat(10, 10, CV_8UC1), {}}),
               std::invalid_argument);
  EXPECT_TRUE(slam.ProcessFrame(good).HasPose());  // nothing of it did harm
}

TEST(Slam, ResetStartsAnew) {
  Slam slam(SlamConfig(), kTwoThreads);
  RenderedSource source(5);
  while (const auto frame = source.Next()) slam.ProcessFrame(*frame);
  slam.Reset();
  EXPECT_EQ(slam.NumSurfels(), 0U);
  EXPECT_TRUE(slam.trajectory().empty());
  EXPECT_TRUE(slam.ModelImage().empty());
  EXPECT_TRUE(slam.ProcessFrame(*RenderedSource(1).Next()).HasPose());  // an earlier stamp is fine
}

TEST(Slam, TinyImagesDoNoHarm) {
  for (const int size : {1, 3, 9, 17, 40}) {
    CameraModel camera = testing::SmallCamera();
    camera.width = camera.height = size;
    camera.fx = camera.fy = size;
    camera.cx = camera.cy = 0.5 * (size - 1);
    Slam slam(SlamConfig(), kTwoThreads);
    const testing::RenderedRoom room = testing::RenderedRoom::Furnished();
    for (int i = 0; i < 3; ++i) {
      slam.ProcessFrame(room.Render(camera, SwayingPose(i), 1 + i * testing::kRenderedInterval));
    }
  }
}

TEST(Slam, RefusesValuesOutOfRangeByTheirFullKey) {
  SlamConfig config;
  config.tracking.so3.max_iterations = -1;
  try {
    const Slam slam(config, 1);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("mapping.tracking.so3.max_iterations"),
              std::string::npos);
  }
}

TEST(Slam, ModelImageShowsTheRoom) {
  Slam slam(SlamConfig(), kTwoThreads);
  RenderedSource source(5);
  RgbdFrame last;
  while (const auto frame = source.Next()) {
    slam.ProcessFrame(*frame);
    last = *frame;
  }
  cv::Mat difference;
  cv::absdiff(slam.ModelImage(), last.rgb, difference);
  EXPECT_LT(cv::mean(difference.reshape(1))[0], 12);  // grey levels
}

TEST(Slam, AJumpOfOdometryIsContradictedOnceAndDoesNoHarm) {
  constexpr int kJump = 10;
  SlamConfig config;
  Slam slam(config, kTwoThreads);
  RenderedSource source(40);
  for (int i = 0; i < 40; ++i) {
    // The origin of the odometry frame is anywhere.
    const Eigen::Isometry3d T_odom_map =
        ExpSE3((Vector6d() << (i < kJump ? 7 : 8), -2, 0, 0, 0, 1).finished());
    FrameHints hints;
    hints.T_odom_camera = T_odom_map * SwayingPose(i);
    const PriorUse use = slam.ProcessFrame(*source.Next(), {}, hints).tracking.prior;
    const bool distrusted = i > kJump && i <= kJump + config.tracking.prior.regain_frames;
    EXPECT_EQ(use, i == 0       ? PriorUse::kNone
                   : i == kJump ? PriorUse::kContradicted
                   : distrusted ? PriorUse::kDistrusted
                                : PriorUse::kUsed)
        << i;
    EXPECT_LT(TranslationError(slam.trajectory(), i), 0.01) << i;
  }
}

TEST(Slam, OdometryMayBeMissingNowAndThen) {
  Slam slam(SlamConfig(), kTwoThreads);
  RenderedSource source(12);
  for (int i = 0; i < 12; ++i) {
    FrameHints hints;
    if (i % 4 != 3) hints.T_odom_camera = SwayingPose(i);
    const FrameResult result = slam.ProcessFrame(*source.Next(), {}, hints);
    EXPECT_TRUE(result.HasPose());
    const bool is_known = i % 4 == 1 || i % 4 == 2;  // in this frame and in the one before
    EXPECT_EQ(result.tracking.prior, is_known ? PriorUse::kUsed : PriorUse::kNone) << i;
  }
}

}  // namespace
}  // namespace posefusion
