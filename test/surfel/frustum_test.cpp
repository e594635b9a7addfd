#include "posefusion/surfel/frustum.h"

#include <gtest/gtest.h>

#include <random>

#include "test/support/rendered_room.h"

namespace posefusion {
namespace {

TEST(Frustum, TouchesEveryBoxThatHoldsAVisiblePoint) {
  const CameraModel camera = testing::SmallCamera();
  const Eigen::Isometry3d T_map_camera = testing::LookAlong({0.3, -0.2, 1}, 0.7, 0.3);
  const Frustum frustum(camera, T_map_camera, 5, 0);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(0, camera.width - 1), v(0, camera.height - 1);
  std::uniform_real_distribution<double> z(0.01, 4.99), size(0, 0.5);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d p = T_map_camera * camera.Unproject(u(random), v(random), z(random));
    Box box;
    box.Add((p - Eigen::Vector3d(size(random), size(random), size(random))).cast<float>());
    box.Add((p + Eigen::Vector3d(size(random), size(random), size(random))).cast<float>());
    EXPECT_TRUE(frustum.Touches(box));
  }
}

TEST(Frustum, LeavesOutWhatIsBehindBesideOrTooFar) {
  const Frustum frustum(testing::SmallCamera(), testing::LookAlong({0, 0, 0}, 0, 0), 5, 0);
  const auto box_at = [](float x, float y, float z) {
    Box box;
    box.Add({x - 0.1F, y - 0.1F, z - 0.1F});
    box.Add({x + 0.1F, y + 0.1F, z + 0.1F});
    return box;
  };
  EXPECT_TRUE(frustum.Touches(box_at(2, 0, 0)));
  EXPECT_FALSE(frustum.Touches(box_at(-2, 0, 0)));
  EXPECT_FALSE(frustum.Touches(box_at(2, 3, 0)));
  EXPECT_FALSE(frustum.Touches(box_at(2, 0, -3)));
  EXPECT_FALSE(frustum.Touches(box_at(6, 0, 0)));
  EXPECT_FALSE(frustum.Touches(Box()));
}

}  // namespace
}  // namespace posefusion
