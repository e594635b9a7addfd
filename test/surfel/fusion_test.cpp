#include "posefusion/surfel/fusion.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "test/surfel/map_fixture.h"

namespace posefusion {
namespace {

using testing::LookAlong;
using testing::MapFixture;
using testing::RenderedRoom;

/// Rendered depth is exact but for float and the smoothing beside edges.
constexpr double kExact = 0.002;

double ShareWithin(const SurfelCloud& cloud, const RenderedRoom& room, double distance_m) {
  const auto near = std::count_if(
      cloud.position_m.begin(), cloud.position_m.end(),
      [&](const Eigen::Vector3f& p) { return room.DistanceTo(p.cast<double>()) < distance_m; });
  return static_cast<double>(near) / static_cast<double>(cloud.size());
}

/// A short walk through the furnished room.
std::vector<Eigen::Isometry3d> Walk(int num_poses) {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < num_poses; ++i) {
    poses.push_back(LookAlong({-1 + 0.02 * i, 0.01 * i, 0.2}, 0.3 - 0.02 * i, 0.3));
  }
  return poses;
}

TEST(Fusion, SurfelsLieOnTheSurfacesThatWereSeen) {
  MapFixture fixture;
  const RenderedRoom room = RenderedRoom::Furnished();
  for (const auto& pose : Walk(20)) fixture.Fuse(room, pose);
  const SurfelCloud cloud = fixture.map.Export(0);
  EXPECT_GT(cloud.size(), 4000U);
  EXPECT_GT(ShareWithin(cloud, room, kExact), 0.98);
}

TEST(Fusion, SecondLookUpdatesInsteadOfCreating) {
  MapFixture fixture;
  const RenderedRoom room = RenderedRoom::Furnished();
  const auto pose = LookAlong({-1, 0, 0.2}, 0, 0.3);
  const FusionCounts first = fixture.Fuse(room, pose);
  const FusionCounts second = fixture.Fuse(room, pose);
  EXPECT_GT(first.created, 3000);
  EXPECT_EQ(first.updated, 0);
  EXPECT_GT(second.updated, 0.97 * first.created);
  EXPECT_LT(second.created, 0.02 * first.created);
}

TEST(Fusion, NormalsPointToTheCamera) {
  MapFixture fixture;
  const auto pose = LookAlong({-1, 0, 0.2}, 0, 0.3);
  fixture.Fuse(RenderedRoom::Furnished(), pose);
  const SurfelCloud cloud = fixture.map.Export(0);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f to_camera = pose.translation().cast<float>() - cloud.position_m[i];
    EXPECT_GT(to_camera.dot(cloud.normal[i]), 0);
    EXPECT_NEAR(cloud.normal[i].norm(), 1, 1e-4);
  }
}

TEST(Fusion, ConfidenceAndLastSeenGrowWithEveryLook) {
  MapFixture fixture;
  const RenderedRoom room = RenderedRoom::Wall(2);
  for (int i = 0; i < 5; ++i) fixture.Fuse(room, LookAlong({0, 0, 0}, 0, 0));
  const SurfelCloud cloud = fixture.map.Export(0);
  const float most = *std::max_element(cloud.confidence.begin(), cloud.confidence.end());
  EXPECT_NEAR(most, 5, 0.1);  // in the middle of the image every look weighs one
  EXPECT_EQ(cloud.last_seen_ns.front() - cloud.first_seen_ns.front(), 4 * testing::kFrameInterval);
}

TEST(Fusion, RemovesWhatFreeSpaceContradicts) {
  const RenderedRoom empty = RenderedRoom::Wall(3);
  RenderedRoom visited = empty;
  visited.AddBox({{1.5, -0.3, -0.5}, {1.7, 0.3, 0.5}});
  MapFixture fixture;
  const auto pose = LookAlong({0, 0, 0}, 0, 0);
  for (int i = 0; i < 15; ++i) fixture.Fuse(visited, pose);
  const auto in_front = [&] {
    const SurfelCloud cloud = fixture.map.Export(0);
    return std::count_if(cloud.position_m.begin(), cloud.position_m.end(),
                         [](const Eigen::Vector3f& p) { return p.x() < 2; });
  };
  ASSERT_GT(in_front(), 300);
  for (int i = 0; i < 10; ++i) fixture.Fuse(empty, pose);
  EXPECT_EQ(in_front(), 0);
}

/// A mask of the whole image.
cv::Mat Everything() {
  const CameraModel camera = testing::SmallCamera();
  return {camera.height, camera.width, CV_8UC1, cv::Scalar::all(255)};
}

TEST(Fusion, DoesNotFusePeople) {
  MapFixture fixture;
  const auto pose = LookAlong({0, 0, 0}, 0, 0);
  EXPECT_EQ(fixture.Fuse(RenderedRoom::Wall(2), pose, Everything()).created, 0);
}

TEST(Fusion, LeavesAloneWhatIsHiddenByPeople) {
  MapFixture fixture;
  const auto pose = LookAlong({0, 0, 0}, 0, 0);
  fixture.Fuse(RenderedRoom::Wall(2), pose);
  const std::size_t before = fixture.map.NumSurfels();
  const FusionCounts counts = fixture.Fuse(RenderedRoom::Wall(1.5), pose, Everything());
  EXPECT_EQ(counts.updated, 0);
  EXPECT_EQ(counts.removed, 0);
  EXPECT_EQ(fixture.map.NumSurfels(), before);
}

TEST(Fusion, RemovesWhatWasFusedOfPeople) {
  for (const double person_m : {2.0, 2.5}) {  // where they are, and nearer: the view is free
    MapFixture fixture;
    const auto pose = LookAlong({0, 0, 0}, 0, 0);
    for (int i = 0; i < 15; ++i) fixture.Fuse(RenderedRoom::Wall(2), pose);
    const double before = static_cast<double>(fixture.map.NumSurfels());
    for (int i = 0; i < 10; ++i) fixture.Fuse(RenderedRoom::Wall(person_m), pose, Everything());
    EXPECT_LT(static_cast<double>(fixture.map.NumSurfels()), 0.1 * before) << person_m;
  }
}

TEST(Fusion, DeletesUnstableSurfelsThatNobodySeesAgain) {
  MapFixture fixture;
  fixture.Fuse(RenderedRoom::Wall(2), LookAlong({0, 0, 0}, 0, 0));
  ASSERT_GT(fixture.map.NumSurfels(), 0U);
  for (int i = 0; i < 60; ++i) {
    fixture.Fuse(RenderedRoom::Wall(2), LookAlong({0, 0, 0}, M_PI, 0));  // sees nothing
  }
  EXPECT_EQ(fixture.map.NumSurfels(), 0U);
}

TEST(Fusion, KeepsStableSurfelsOutOfView) {
  MapFixture fixture;
  for (int i = 0; i < 30; ++i) fixture.Fuse(RenderedRoom::Wall(2), LookAlong({0, 0, 0}, 0, 0));
  const std::size_t stable = fixture.map.Export(10).size();
  ASSERT_GT(stable, 1000U);
  for (int i = 0; i < 60; ++i) fixture.Fuse(RenderedRoom::Wall(2), LookAlong({0, 0, 0}, M_PI, 0));
  EXPECT_EQ(fixture.map.NumSurfels(), stable);
}

TEST(Fusion, InactiveSurfelsAreLeftAlone) {
  FusionConfig config;
  config.time_window_s = 0.5;
  config.unstable_life_s = 1e6;
  MapFixture fixture(2, config);
  const auto pose = LookAlong({0, 0, 0}, 0, 0);
  const FusionCounts first = fixture.Fuse(RenderedRoom::Wall(2), pose);
  for (int i = 0; i < 20; ++i) fixture.Fuse(RenderedRoom::Wall(2), LookAlong({0, 0, 0}, M_PI, 0));
  const FusionCounts again = fixture.Fuse(RenderedRoom::Wall(2), pose);
  EXPECT_EQ(again.updated, 0);
  EXPECT_GT(again.created, 0.9 * first.created);
}

TEST(Fusion, SameBitsForAnyNumberOfThreads) {
  const auto digest = [](int num_threads) {
    MapFixture fixture(num_threads);
    for (const auto& pose : Walk(10)) fixture.Fuse(RenderedRoom::Furnished(), pose);
    return fixture.map.Digest();
  };
  const std::uint64_t expected = digest(1);
  EXPECT_EQ(digest(2), expected);
  EXPECT_EQ(digest(5), expected);
}

}  // namespace
}  // namespace posefusion
