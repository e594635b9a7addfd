#include "posefusion/common/trajectory.h"

#include <gtest/gtest.h>

namespace posefusion {
namespace {

TEST(Trajectory, NearestPoseIsTheOneWithTheNearestStamp) {
  Trajectory trajectory;
  for (const StampNs stamp_ns : {100'000'000, 200'000'000, 300'000'000}) {
    trajectory.push_back({stamp_ns, Eigen::Isometry3d::Identity()});
  }
  const auto nearest = [&](StampNs stamp_ns) { return NearestPose(trajectory, stamp_ns, 0.045); };
  EXPECT_EQ(nearest(200'000'000), &trajectory[1]);
  EXPECT_EQ(nearest(160'000'000), &trajectory[1]);
  EXPECT_EQ(nearest(240'000'000), &trajectory[1]);
  EXPECT_EQ(nearest(340'000'000), &trajectory[2]);
  EXPECT_EQ(nearest(60'000'000), &trajectory[0]);
  EXPECT_EQ(nearest(150'000'000), nullptr);
  EXPECT_EQ(nearest(350'000'000), nullptr);
  EXPECT_EQ(NearestPose({}, 0, 1), nullptr);
}

TEST(Trajectory, InterpolatesBetweenPosesAndNowhereElse) {
  const auto at = [](double x, double yaw_rad) {
    Eigen::Isometry3d T(Eigen::Translation3d(x, 0, 0));
    T.rotate(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
    return T;
  };
  const Trajectory trajectory = {
      {100'000'000, at(0, 0)}, {200'000'000, at(1, 0.4)}, {900'000'000, at(2, 0.4)}};
  const auto pose = [&](StampNs stamp_ns) { return InterpolatedPose(trajectory, stamp_ns, 0.25); };
  EXPECT_TRUE(pose(125'000'000)->isApprox(at(0.25, 0.1), 1e-12));
  EXPECT_TRUE(pose(100'000'000)->isApprox(at(0, 0)));
  EXPECT_TRUE(pose(900'000'000)->isApprox(at(2, 0.4)));
  EXPECT_FALSE(pose(99'999'999));
  EXPECT_FALSE(pose(900'000'001));
  EXPECT_FALSE(pose(300'000'000)) << "the pause is too long";
  EXPECT_FALSE(InterpolatedPose({}, 0, 1));
}

}  // namespace
}  // namespace posefusion
