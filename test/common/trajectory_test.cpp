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

}  // namespace
}  // namespace posefusion
