#include "posefusion/segmentation/background_surfaces.h"

#include <gtest/gtest.h>

#include "posefusion/segmentation/seeds.h"
#include "test/segmentation/synthetic_person.h"

namespace posefusion {
namespace {

class BackgroundSurfacesTest : public testing::Test {
 protected:
  void Find(const SyntheticScene& scene, const std::vector<BodyPoint>& seeds) {
    cells_.Build(scene.Render().depth_m, scene.camera);
    BackgroundSurfaces(BackgroundSurfacesConfig())
        .Find(cells_, seeds, known_people_, planes_, background_);
  }

  static std::vector<BodyPoint> SeedsOf(const SyntheticScene& scene) {
    std::vector<BodyPoint> seeds;
    for (const Seed& seed : LiftPerson(scene.Joints(), scene.Render(), SeedConfig()).seeds) {
      seeds.push_back(seed.OnBody());
    }
    return seeds;
  }

  CellGrid cells_{CellGridConfig()};
  cv::Mat known_people_;
  std::vector<Plane> planes_;
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

/// A slab that fills the view but for a strip; one joint of it was found, far from the strip.
struct CoveredView {
  CoveredView() {
    scene.person_m = 1.0;
    scene.half_width_m = 0.5;
    scene.top_m = -2;
  }
  SyntheticScene scene;
  std::vector<BodyPoint> seeds = {{{-0.4F, 0.3F, 1.0F}}};
};

TEST_F(BackgroundSurfacesTest, KnownPeopleAreNoSurface) {
  const CoveredView view;
  Find(view.scene, view.seeds);
  ASSERT_EQ(background_.at(80, 60), 1) << "a flat front without joints would be one";
  planes_.clear();
  known_people_ = cv::Mat(background_.height(), background_.width(), CV_8UC1, cv::Scalar(255));
  Find(view.scene, view.seeds);
  EXPECT_EQ(background_.at(80, 60), 0);
}

TEST_F(BackgroundSurfacesTest, AreRememberedWherePeopleHideThem) {
  SyntheticScene scene;
  scene.floor_m = 0.6;
  Find(scene, SeedsOf(scene));
  ASSERT_FALSE(planes_.empty());
  known_people_ = cv::Mat(background_.height(), background_.width(), CV_8UC1, cv::Scalar(255));
  known_people_.colRange(0, 16).setTo(0);  // all that may be looked at
  known_people_.rowRange(0, 100).setTo(255);
  Find(scene, SeedsOf(scene));
  EXPECT_EQ(background_.at(140, 116), 1) << "floor that is called person";
  planes_.clear();
  Find(scene, SeedsOf(scene));
  EXPECT_EQ(background_.at(140, 116), 0) << "nobody knew it";
}

TEST_F(BackgroundSurfacesTest, AreForgottenWhenTheCameraLooksElsewhere) {
  SyntheticScene scene;
  Find(scene, SeedsOf(scene));
  const std::size_t num_planes = planes_.size();
  scene.wall_m = 4.5;
  scene.floor_m = 1.6;
  Find(scene, SeedsOf(scene));
  EXPECT_LE(planes_.size(), num_planes);
  for (const Plane& plane : planes_) {
    const float distance = std::abs(plane.offset_m);
    EXPECT_TRUE(std::abs(distance - 4.5F) < 0.05F || std::abs(distance - 1.6F) < 0.05F) << distance;
  }
}

TEST_F(BackgroundSurfacesTest, AreNotLookedForWithoutSeeds) {
  Find(SyntheticScene(), {});
  EXPECT_EQ(background_.at(20, 40), 0);
}

}  // namespace
}  // namespace posefusion
