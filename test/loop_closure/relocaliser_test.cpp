#include "posefusion/loop_closure/relocaliser.h"

#include <gtest/gtest.h>

#include "test/loop_closure/mapped_room.h"

namespace posefusion {
namespace {

using testing::LookAlong;
using testing::MappedRoom;

constexpr double kMaxErrorM = 0.01;

/// A relocaliser that has seen three views of a mapped room.
class RelocaliserTest : public ::testing::Test {
 protected:
  RelocaliserTest() {
    tracker_.Start(room_.Frame(kSeen[0]), kSeen[0]);
    TrackingResult good;
    good.health = TrackingHealth::kGood;
    for (const Eigen::Isometry3d& pose : kSeen) {
      good.T_map_camera = pose;
      for (int i = 0; i < config_.settle_frames; ++i) {
        relocaliser_.NoteTracked(room_.Frame(pose), good);
      }
    }
    views_.small = [this](const Eigen::Isometry3d& pose) -> const ModelView& {
      ++num_small_;
      return room_.View(pose, MappedRoom::kSmallLevel);
    };
    views_.normal = [this](const Eigen::Isometry3d& pose) -> const ModelView& {
      ++num_normal_;
      return room_.View(pose, 0);
    };
  }

  static RelocalisationConfig SmallImages() {
    RelocalisationConfig config;
    config.ferns.level = MappedRoom::kSmallLevel;
    return config;
  }

  std::optional<TrackingResult> Find(const Eigen::Isometry3d& pose,
                                     const cv::Mat& mask = cv::Mat()) {
    return relocaliser_.Find(room_.Frame(pose, mask), views_, room_.parallel(), tracker_);
  }

  const std::vector<Eigen::Isometry3d> kSeen = {LookAlong({-1, 0, 0.2}, 0.1, 0.2),
                                                LookAlong({-1, 0.2, 0.2}, 0.5, 0.2),
                                                LookAlong({-1, -0.2, 0.2}, -0.3, 0.2)};
  const Eigen::Isometry3d kUnknown = LookAlong({-1, 0, 0.2}, 3.2, 0.2);
  const cv::Mat kCovered = cv::Mat(120, 160, CV_8UC1, cv::Scalar::all(255));
  RelocalisationConfig config_ = SmallImages();
  MappedRoom room_{kSeen};
  Tracker tracker_{TrackingConfig(), room_.noise()};
  Relocaliser relocaliser_{config_, TrackingConfig(), room_.pyramid_config(), room_.noise()};
  MapViews views_;
  int num_small_ = 0;
  int num_normal_ = 0;
};

TEST_F(RelocaliserTest, BelievesAPoseOnlyWhenTheNextFramesConfirmIt) {
  const Eigen::Isometry3d pose = LookAlong({-0.9, 0.1, 0.2}, 0.2, 0.2);
  for (int i = 0; i < config_.confirmations; ++i) EXPECT_FALSE(Find(pose));
  const auto found = Find(pose);
  ASSERT_TRUE(found);
  EXPECT_LT((found->T_map_camera.translation() - pose.translation()).norm(), kMaxErrorM);
}

TEST_F(RelocaliserTest, ForgivesOneFrameThatConfirmsNothing) {
  const Eigen::Isometry3d pose = LookAlong({-0.9, 0.1, 0.2}, 0.2, 0.2);
  for (int i = 0; i < config_.confirmations; ++i) EXPECT_FALSE(Find(pose));
  EXPECT_FALSE(Find(pose, kCovered));
  EXPECT_TRUE(Find(pose));
}

TEST_F(RelocaliserTest, TwoFramesThatConfirmNothingStartTheSearchAnew) {
  const Eigen::Isometry3d pose = LookAlong({-0.9, 0.1, 0.2}, 0.2, 0.2);
  for (int i = 0; i < config_.confirmations; ++i) EXPECT_FALSE(Find(pose));
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(Find(pose, kCovered));
  for (int i = 0; i < config_.confirmations; ++i) EXPECT_FALSE(Find(pose));
  EXPECT_TRUE(Find(pose));
}

TEST_F(RelocaliserTest, APoseFarFromTheOneBeforeConfirmsNothing) {
  for (int i = 0; i < 10; ++i) {
    const double yaw_rad = i % 2 == 0 ? -0.25 : 0.45;  // 20 rad/s
    EXPECT_FALSE(Find(LookAlong({-1, 0, 0.2}, yaw_rad, 0.2))) << i;
  }
}

TEST_F(RelocaliserTest, AnUnknownPlaceIsNeverFound) {
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(Find(kUnknown)) << i;
}

TEST_F(RelocaliserTest, ALostFrameCostsFewViews) {
  for (int i = 0; i < 10; ++i) Find(kUnknown);
  EXPECT_LE(num_small_, 10 * config_.candidates_per_frame);
  EXPECT_LE(num_normal_, 10);
  num_small_ = num_normal_ = 0;
  for (int i = 0; i < 10; ++i) Find(kSeen[0], kCovered);
  EXPECT_EQ(num_small_ + num_normal_, 0);  // nothing to see, nothing to try
}

TEST_F(RelocaliserTest, DoubtfulFramesDoNotBecomeKeyframes) {
  const int keyframes = relocaliser_.num_keyframes();
  TrackingResult result;
  result.T_map_camera = kUnknown;
  for (int i = 0; i < 20; ++i) {
    result.health = i % config_.settle_frames == 0 ? TrackingHealth::kWeak : TrackingHealth::kGood;
    relocaliser_.NoteTracked(room_.Frame(kUnknown), result);
  }
  EXPECT_EQ(relocaliser_.num_keyframes(), keyframes);
}

}  // namespace
}  // namespace posefusion
