#include "posefusion/surfel/surfel_map.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <set>

#include "test/surfel/map_fixture.h"

namespace posefusion {
namespace {

using testing::LookAlong;
using testing::MapFixture;
using testing::RenderedRoom;

Surfel SurfelAt(float x, float y, float z) {
  Surfel surfel;
  surfel.position_m = {x, y, z};
  surfel.radius_m = 0.01F;
  surfel.confidence = 1;
  surfel.first_seen = surfel.last_seen = 1;
  return surfel;
}

/// A view of the furnished room, sometimes with an extra box in it.
struct Look {
  RenderedRoom room = RenderedRoom::Furnished();
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
};

Look AnyLook() {
  Look look;
  const double x = *rc::gen::inRange(-150, 30) * 0.01;
  const double yaw = *rc::gen::inRange(-300, 300) * 0.01;
  look.T_map_camera = LookAlong({x, 0.1, 0.2}, yaw, 0.25);
  if (*rc::gen::arbitrary<bool>()) look.room.AddBox({{0.1, -0.3, -0.4}, {0.3, 0.1, 0.3}});
  return look;
}

TEST(SurfelMap, UndoTakesFramesBackBitByBit) {
  const bool holds = rc::check("undo after any frames", [] {
    SurfelMapConfig config;
    config.undo_frames = 4;
    MapFixture fixture(2, {}, config);
    std::vector<Look> looks;
    std::vector<std::uint64_t> digests = {fixture.map.Digest()};
    const int num_frames = *rc::gen::inRange(2, 8);
    for (int i = 0; i < num_frames; ++i) {
      looks.push_back(AnyLook());
      fixture.Fuse(looks.back().room, looks.back().T_map_camera);
      digests.push_back(fixture.map.Digest());
    }
    const int num_undone = *rc::gen::inRange(1, std::min(num_frames, config.undo_frames) + 1);
    for (int i = 1; i <= num_undone; ++i) {
      RC_ASSERT(fixture.map.UndoFrame());
      RC_ASSERT(fixture.map.Digest() == digests[static_cast<std::size_t>(num_frames - i)]);
    }
  });
  EXPECT_TRUE(holds);
}

TEST(SurfelMap, FusingAgainAfterUndoGivesTheSameMap) {
  MapFixture undone;
  MapFixture straight;
  const RenderedRoom room = RenderedRoom::Furnished();
  const auto pose = [](int i) { return LookAlong({-1 + 0.05 * i, 0, 0.2}, 0.1 * i, 0.3); };
  const auto content = [](const SurfelMap& map) {
    const SurfelCloud cloud = map.Export(0);
    return std::make_pair(cloud.position_m, cloud.confidence);
  };
  for (int i = 0; i < 4; ++i) {
    undone.Fuse(room, pose(i));
    straight.Fuse(room, pose(i));
  }
  undone.Fuse(room, LookAlong({0.5, 0.5, 0.5}, 2, 0));  // taken back
  ASSERT_TRUE(undone.map.UndoFrame());
  undone.Fuse(room, pose(4));
  straight.Fuse(room, pose(4));
  EXPECT_EQ(content(undone.map), content(straight.map));
}

TEST(SurfelMap, UndoesNoMoreFramesThanAsked) {
  SurfelMapConfig config;
  config.undo_frames = 2;
  SurfelMap map(config);
  for (StampNs stamp = 1; stamp <= 5; ++stamp) {
    map.BeginFrame(stamp);
    map.Insert(SurfelAt(static_cast<float>(stamp), 0, 0));
  }
  EXPECT_TRUE(map.UndoFrame());
  EXPECT_TRUE(map.UndoFrame());
  EXPECT_FALSE(map.UndoFrame());
  EXPECT_EQ(map.NumSurfels(), 3U);
}

TEST(SurfelMap, IdsAreNeverUsedTwice) {
  SurfelMap map{SurfelMapConfig()};
  map.BeginFrame(1);
  for (int i = 0; i < 2000; ++i) map.Insert(SurfelAt(0.001F * static_cast<float>(i), 0, 0));
  std::set<std::uint32_t> ids;
  for (std::uint32_t c = 0; c < map.NumChunks(); ++c) {
    for (int slot = 0; slot < map.chunk(c).size; ++slot) ids.insert(map.chunk(c).Get(slot).id);
  }
  EXPECT_EQ(ids.size(), 2000U);
}

TEST(SurfelMap, ChunksHoldNeighboursOnly) {
  SurfelMapConfig config;
  config.voxel_size_m = 0.5;
  SurfelMap map(config);
  map.BeginFrame(1);
  for (int i = 0; i < 3000; ++i) {
    map.Insert(
        SurfelAt(0.01F * static_cast<float>(i % 300), 0.1F * static_cast<float>(i / 300), 0));
  }
  for (std::uint32_t c = 0; c < map.NumChunks(); ++c) {
    EXPECT_LE((map.chunk(c).box.max - map.chunk(c).box.min).maxCoeff(), 0.5F);
    EXPECT_LE(map.chunk(c).num_alive, kChunkCapacity);
  }
}

TEST(SurfelMap, FindsTheChunksInView) {
  SurfelMap map{SurfelMapConfig()};
  map.BeginFrame(1);
  map.Insert(SurfelAt(2, 0, 0));
  map.Insert(SurfelAt(-2, 0, 0));
  map.Insert(SurfelAt(20, 5, 0));
  std::vector<std::uint32_t> visible;
  map.FindVisible(Frustum(testing::SmallCamera(), LookAlong({0, 0, 0}, 0, 0), 100, 1), visible);
  EXPECT_EQ(visible, (std::vector<std::uint32_t>{0, 2}));
}

TEST(SurfelMap, FirstFrameSinceFindsTheFrameNotOlder) {
  SurfelMap map{SurfelMapConfig()};
  for (const StampNs stamp : {10, 20, 30}) map.BeginFrame(stamp);
  EXPECT_EQ(map.FirstFrameSince(5), 1U);
  EXPECT_EQ(map.FirstFrameSince(20), 2U);
  EXPECT_EQ(map.FirstFrameSince(21), 3U);
  EXPECT_EQ(map.FirstFrameSince(31), 4U);
}

TEST(SurfelMap, ExportKeepsStampsAndColours) {
  SurfelMap map{SurfelMapConfig()};
  map.BeginFrame(123);
  Surfel surfel = SurfelAt(1, 2, 3);
  surfel.rgb = {10.4F, 300, -5};
  map.Insert(surfel);
  surfel.confidence = 0.1F;
  map.Insert(surfel);
  const SurfelCloud cloud = map.Export(0.5F);
  ASSERT_EQ(cloud.size(), 1U);
  EXPECT_EQ(cloud.rgb[0], (std::array<std::uint8_t, 3>{10, 255, 0}));
  EXPECT_EQ(cloud.first_seen_ns[0], 123);
}

}  // namespace
}  // namespace posefusion
