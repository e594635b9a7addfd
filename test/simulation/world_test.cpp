#include "posefusion/simulation/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "posefusion/simulation/floor_grid.h"
#include "posefusion/simulation/simulator.h"
#include "posefusion/simulation/true_meshes.h"
#include "test/simulation/turning_head.h"

namespace posefusion {
namespace {

WorldConfig Config(int humans, int seed = 1, double seconds = 60) {
  WorldConfig config;
  config.humans = humans;
  config.seed = seed;
  config.seconds = seconds;
  return config;
}

TEST(World, IsTheSameForTheSameSeed) {
  const World a(Config(3, 5));
  const World b(Config(3, 5));
  const World other(Config(3, 6));
  bool differs = false;
  for (double t = 0; t < 60; t += 3.7) {
    for (int person = 0; person < 3; ++person) {
      const Eigen::Vector3d nose = a.PersonAt(person, t).joints[kNose];
      EXPECT_EQ(nose, b.PersonAt(person, t).joints[kNose]);
      differs = differs || nose != other.PersonAt(person, t).joints[kNose];
    }
  }
  EXPECT_TRUE(differs);
}

TEST(World, PeopleMoveWithoutJumps) {
  constexpr double kStep_s = 0.01;
  constexpr double kFastestJoint = 9.0;  // metres per second: a swinging foot, a waving hand
  const World world(Config(4, 2, 80));
  for (int person = 0; person < 4; ++person) {
    PersonPose before = world.PersonAt(person, 0);
    for (double t = kStep_s; t < 80; t += kStep_s) {
      const PersonPose now = world.PersonAt(person, t);
      for (int joint = 0; joint < kNumCocoJoints; ++joint) {
        const auto i = static_cast<std::size_t>(joint);
        ASSERT_LT((now.joints[i] - before.joints[i]).norm(), kFastestJoint * kStep_s)
            << "person " << person << " joint " << joint << " at " << t << " s";
      }
      before = now;
    }
  }
}

TEST(World, PeopleDoNotWalkThroughFurniture) {
  constexpr double kDepthOfToes = 0.12;  // how far the middle of a body may be inside of a box
  for (const auto room : {RoomKind::kLab, RoomKind::kCorridor}) {
    WorldConfig config = Config(4, 3, 90);
    config.room = room;
    const World world(config);
    for (const int person : {0, 2, 3}) {
      int inside = 0;
      for (double t = 0; t < 90; t += 0.1) {
        const Eigen::Vector3d hips = world.PersonAt(person, t).T_map_part[kPelvis].translation();
        if (hips.z() < 0.7) continue;  // sits
        for (auto box : world.obstacles()) {
          const Eigen::Vector2d margin = Eigen::Vector2d::Constant(kDepthOfToes);
          if ((box.sizes().array() < 2 * kDepthOfToes).any()) continue;
          box = Eigen::AlignedBox2d(box.min() + margin, box.max() - margin);
          if (box.contains(hips.head<2>())) ++inside;
        }
      }
      EXPECT_LT(inside, 12) << "tenths of a second, getting up apart; person " << person;
    }
  }
}

TEST(World, SecondPersonSitsMotionlessForHalfAMinute) {
  const World world(Config(2, 4));
  const PersonPose first = world.PersonAt(1, 0);
  EXPECT_LT(first.joints[kLeftHip].z(), 0.6);
  for (double t = 0; t < 31; t += 0.9) {
    for (int joint = 0; joint < kNumCocoJoints; ++joint) {
      const auto i = static_cast<std::size_t>(joint);
      EXPECT_EQ(world.PersonAt(1, t).joints[i], first.joints[i]);
    }
  }
  double highest = 0;
  for (double t = 31; t < 60; t += 0.5) {
    highest = std::max(highest, world.PersonAt(1, t).joints[kLeftHip].z());
  }
  EXPECT_GT(highest, 0.8) << "and then gets up";
}

TEST(World, SomebodyPushesTheChairWithTheirHandsBehindIt) {
  const World world(Config(1));
  const auto moved = world.moved_objects();
  ASSERT_FALSE(moved.empty());
  EXPECT_EQ(moved.front().name, "chair");
  EXPECT_GT(moved.front().offset_m.norm(), 0.5);
  const double middle_s = (moved.front().from_s + moved.front().to_s) / 2;
  const Eigen::Vector3d chair = world.T_map_movable(0, middle_s).translation();
  const Eigen::Vector3d hips = world.PersonAt(0, middle_s).T_map_part[kPelvis].translation();
  EXPECT_LT((chair - hips).head<2>().norm(), 0.8);
  const Eigen::Vector3d way =
      world.T_map_movable(0, 60).translation() - world.T_map_movable(0, 0).translation();
  EXPECT_NEAR((way - moved.front().offset_m).norm(), 0, 1e-9);
}

TEST(World, NothingMovesWithoutPeople) {
  const World world(Config(0));
  EXPECT_TRUE(world.moved_objects().empty());
  for (int i = 0; i < world.num_movables(); ++i) {
    EXPECT_TRUE(world.T_map_movable(i, 0).isApprox(world.T_map_movable(i, 50)));
  }
}

TEST(TrueMeshes, ThingsThatStayBelongToTheRoom) {
  const World world(Config(0));
  std::size_t num_triangles = world.static_mesh().triangles.size();
  for (int i = 0; i < world.num_movables(); ++i) {
    num_triangles += world.movable_mesh(i).triangles.size();
  }
  const TriangleMesh mesh = UnmovedSurfaces(world);
  EXPECT_EQ(mesh.triangles.size(), num_triangles);
  const Eigen::Vector3f last = (world.T_map_movable(world.num_movables() - 1, 0).cast<float>() *
                                world.movable_mesh(world.num_movables() - 1).vertices.back());
  EXPECT_LT((mesh.vertices.back() - last).norm(), 1e-6F);
  EXPECT_EQ(mesh.triangles.back().maxCoeff() + 1, static_cast<int>(mesh.vertices.size()));
  EXPECT_TRUE(MovedSurfacesOf(world).empty());
}

TEST(TrueMeshes, MovedThingsHaveASurfaceAtBothPlaces) {
  const World world(Config(1));
  const auto surfaces = MovedSurfacesOf(world);
  ASSERT_EQ(surfaces.size(), world.moved_objects().size());
  ASSERT_FALSE(surfaces.empty());
  std::size_t num_triangles = UnmovedSurfaces(world).triangles.size();
  for (const MovedSurfaces& object : surfaces) {
    const Eigen::Vector3f way = object.after.vertices.front() - object.before.vertices.front();
    EXPECT_LT((way - object.offset_m.cast<float>()).norm(), 1e-5F) << object.name;
    EXPECT_GT(way.norm(), 0.3F) << object.name;
    EXPECT_LT(object.begin_ns, object.end_ns);
    num_triangles += object.before.triangles.size();
  }
  EXPECT_EQ(num_triangles, UnmovedSurfaces(World(Config(0))).triangles.size());
}

TEST(TrueMeshes, WhatIsMovedAfterTheRunStays) {
  for (const double seconds : {2.0, 10.0, 25.0}) {
    for (const MovedObject& object : World(Config(1, 1, seconds)).moved_objects()) {
      EXPECT_LT(object.from_s, seconds);
    }
  }
}

/// Walks around the table without end.
class CirclingHead : public HeadMotion {
 public:
  explicit CirclingHead(double rad_per_s) : rad_per_s_(rad_per_s) {}
  Eigen::Isometry3d T_map_camera(double time_s) const override {
    const double angle = rad_per_s_ * time_s - 2.2;
    Eigen::Isometry3d T = testing::TurningHead(0, angle + 2.5).T_map_camera(0);
    T.translation() << 1.55 * std::cos(angle), 1.25 * std::sin(angle), 1.4;
    return T;
  }

 private:
  double rad_per_s_;
};

TEST(World, PeopleKeepOffACameraThatWalks) {
  constexpr double kBodyRadius = 0.3;
  for (int seed = 1; seed <= 6; ++seed) {
    WorldConfig config = Config(3, seed, 90);
    config.head = std::make_shared<CirclingHead>(seed % 2 == 0 ? 0.25 : -0.2);
    const World world(config);
    for (double t = 0; t < 90; t += 0.1) {
      const Eigen::Vector3d camera = config.head->T_map_camera(t).translation();
      for (int person = 0; person < 3; ++person) {
        const Eigen::Vector3d hips = world.PersonAt(person, t).T_map_part[kPelvis].translation();
        EXPECT_GT((hips - camera).head<2>().norm(), kBodyRadius)
            << "seed " << seed << " person " << person << " at " << t << " s";
      }
    }
  }
}

TEST(World, PeopleCrossBeforeTheCamera) {
  WorldConfig config = Config(3, 1, 120);
  config.head = std::make_shared<testing::TurningHead>();
  const World world(config);
  int near_in_view = 0;
  for (double t = 0; t < 120; t += 0.1) {
    const Eigen::Isometry3d T_camera_map = config.head->T_map_camera(t).inverse();
    for (int person = 0; person < 3; ++person) {
      const Eigen::Vector3d chest =
          T_camera_map * world.PersonAt(person, t).T_map_part[kChest].translation();
      if (chest.z() > 0.3 && chest.z() < 1.3 && std::abs(chest.x()) < 0.3) ++near_in_view;
    }
  }
  EXPECT_GT(near_in_view, 3);
}

TEST(World, CorridorRouteIsLongAndFree) {
  const auto route = CorridorRoute();
  WorldConfig config = Config(0);
  config.room = RoomKind::kCorridor;
  const World world(config);
  double length = 0;
  for (std::size_t i = 0; i + 1 < route.size(); ++i) {
    length += (route[i + 1] - route[i]).norm();
    for (double s = 0; s <= 1; s += 0.02) {
      const Eigen::Vector2d at = route[i] + s * (route[i + 1] - route[i]);
      for (const auto& box : world.obstacles()) {
        EXPECT_GT(box.exteriorDistance(at), 0.25) << at.transpose();
      }
    }
  }
  EXPECT_GT(length, 60.0);
  EXPECT_LT((route.front() - route.back()).norm(), 0.01);
}

TEST(World, RefusesImpossibleNumbers) {
  EXPECT_THROW(World(Config(-1)), std::invalid_argument);
  EXPECT_THROW(World(Config(7)), std::invalid_argument);
  EXPECT_THROW(World(Config(1, 1, 0)), std::invalid_argument);
}

TEST(FloorGrid, FindsAWayAroundAnObstacle) {
  const Eigen::AlignedBox2d floor(Eigen::Vector2d(-3, -3), Eigen::Vector2d(3, 3));
  const Eigen::AlignedBox2d box(Eigen::Vector2d(-1, -2), Eigen::Vector2d(1, 2));
  const FloorGrid grid(floor, {box}, 0.25);
  const auto way = grid.Way({-2, 0}, {2, 0});
  ASSERT_GT(way.size(), 2U);
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    EXPECT_GT(box.exteriorDistance(Eigen::Vector2d((way[i] + way[i + 1]) / 2)), 0.1);
  }
  const Eigen::AlignedBox2d wall(Eigen::Vector2d(-1, -3), Eigen::Vector2d(1, 3));
  EXPECT_TRUE(FloorGrid(floor, {wall}, 0.25).Way({-2, 0}, {2, 0}).empty());
}

}  // namespace
}  // namespace posefusion
