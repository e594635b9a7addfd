#include "posefusion/segmentation/background_surfaces.h"

#include <gtest/gtest.h>

#include "posefusion/segmentation/seeds.h"
#include "test/segmentation/synthetic_person.h"

namespace posefusion {
namespace {

class BackgroundSurfacesTest : public testing::Test {
 protected:
  void Find(const SyntheticScene& scene, const std::vector<Eigen::Vector3f>& seeds) {
    cells_.Build(scene.Render().depth_m, scene.camera);
    BackgroundSurfaces(BackgroundSurfacesConfig()).Find(cells_, seeds, background_);
  }

  static std::vector<Eigen::Vector3f> SeedsOf(const SyntheticScene& scene) {
    std::vector<Eigen::Vector3f> seeds;
    for (const Seed& seed : LiftPerson(scene.Joints(), scene.Render(), SeedConfig()).seeds) {
      seeds.push_back(seed.p_camera);
    }
    return seeds;
  }

  CellGrid cells_{CellGridConfig()};
  Grid<std::uint8_t> background_;
};

TEST_F(BackgroundSurfacesTest, AreFollowedUpToThePerson) {
  SyntheticScene scene;
  scene.person_m = 3.0;
  scene.wall_m = 4.5;
  Find(scene, SeedsOf(scene));
  EXPECT_EQ(background_.at(20, 40), 1) << "wall";
  EXPECT_EQ(background_.at(20, 116), 1) << "floor";
  EXPECT_EQ(background_.at(80, 117), 1) << "floor before the feet";
}

TEST_F(BackgroundSurfacesTest, LeaveThePersonFree) {
  const SyntheticScene scene;
  Find(scene, SeedsOf(scene));
  for (int y = 40; y < 110; ++y) EXPECT_EQ(background_.at(80, y), 0) << y;
}

TEST_F(BackgroundSurfacesTest, HoldPeopleSeenInAWall) {
  SyntheticScene scene;
  scene.wall_m = scene.person_m;  // the figure is drawn on the wall
  Find(scene, SeedsOf(scene));
  EXPECT_EQ(background_.at(80, 60), 1);
}

TEST_F(BackgroundSurfacesTest, AreNotLookedForWithoutSeeds) {
  Find(SyntheticScene(), {});
  EXPECT_EQ(background_.at(20, 40), 0);
}

}  // namespace
}  // namespace posefusion
