#include "posefusion/loop_closure/coarse_aligner.h"

#include <gtest/gtest.h>

#include "test/loop_closure/mapped_room.h"

namespace posefusion {
namespace {

using testing::LookAlong;
using testing::MappedRoom;

/// From there the tracker's own alignment finds the rest.
constexpr double kMaxErrorM = 0.05;
constexpr double kMaxErrorRad = 0.05;

TEST(CoarseAligner, ReachesThirtyCentimetresAndFifteenDegrees) {
  const Eigen::Isometry3d keyframe = LookAlong({-1, 0, 0.2}, 0.1, 0.2);
  MappedRoom room(
      {keyframe, LookAlong({-1, 0.2, 0.2}, 0.4, 0.2), LookAlong({-1, -0.2, 0.2}, -0.2, 0.2)});
  RelocalisationConfig config;
  config.ferns.level = MappedRoom::kSmallLevel;
  CoarseAligner aligner(config, TrackingConfig(), room.noise());
  const std::vector<Eigen::Isometry3d> poses = {
      LookAlong({-1, 0.3, 0.2}, 0.1, 0.2), LookAlong({-1, -0.3, 0.2}, 0.1, 0.2),
      LookAlong({-0.75, 0, 0.2}, 0.36, 0.2), LookAlong({-0.8, 0.2, 0.1}, -0.15, 0.25)};
  for (const Eigen::Isometry3d& pose : poses) {
    const auto T_view_camera =
        aligner.Align(room.Frame(pose), room.View(keyframe, 1), room.parallel());
    ASSERT_TRUE(T_view_camera);
    const Eigen::Isometry3d T_error = pose.inverse() * keyframe * *T_view_camera;
    EXPECT_LT(T_error.translation().norm(), kMaxErrorM) << pose.matrix();
    EXPECT_LT(LogSO3(T_error.linear()).norm(), kMaxErrorRad) << pose.matrix();
  }
}

TEST(CoarseAligner, SaysWhenThereIsNothingToAlignTo) {
  MappedRoom room({LookAlong({-1, 0, 0.2}, 0.1, 0.2)});
  RelocalisationConfig config;
  config.ferns.level = MappedRoom::kSmallLevel;
  CoarseAligner aligner(config, TrackingConfig(), room.noise());
  const Eigen::Isometry3d behind = LookAlong({-1, 0, 0.2}, 3.2, 0.2);
  EXPECT_FALSE(aligner.Align(room.Frame(behind), room.View(behind, 1), room.parallel()));
}

}  // namespace
}  // namespace posefusion
