#include "posefusion/surfel/splatter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "test/surfel/map_fixture.h"

namespace posefusion {
namespace {

using testing::LookAlong;
using testing::MapFixture;
using testing::RenderedRoom;

/// Predictions agree with rendered depth but for float arithmetic and slanted footprints.
constexpr double kDepthTolerance = 0.004;

SplatConfig FullResolution() {
  SplatConfig config;
  config.level = 0;
  return config;
}

TEST(Splatter, PredictsTheDepthOfATiltedPlane) {
  MapFixture fixture;
  const RenderedRoom room = RenderedRoom::Wall(2);
  const auto pose = LookAlong({0, 0, 0}, 0.5, 0.2);
  for (int i = 0; i < 3; ++i) fixture.Fuse(room, pose);
  const RgbdFrame truth = room.Render(testing::SmallCamera(), pose, 0);
  const ModelView view = fixture.Predict(pose, FullResolution());
  for (int y = 4; y < 116; ++y) {
    for (int x = 4; x < 156; ++x) {
      EXPECT_NEAR(view.depth_m.at(x, y), truth.depth_m.at<float>(y, x), kDepthTolerance);
    }
  }
}

TEST(Splatter, PlanesAndIntensityAgreeWithTheScene) {
  MapFixture fixture;
  const RenderedRoom room = RenderedRoom::Wall(2);
  const auto pose = LookAlong({0, 0, 0}, 0.2, 0);
  for (int i = 0; i < 3; ++i) fixture.Fuse(room, pose);
  const ModelView view = fixture.Predict(pose, FullResolution());
  const Eigen::Vector3d normal = pose.linear().transpose() * -Eigen::Vector3d::UnitX();
  const RgbdFrame truth = room.Render(testing::SmallCamera(), pose, 0);
  double difference = 0;
  for (int y = 10; y < 110; ++y) {
    for (int x = 10; x < 150; ++x) {
      const ModelPlane& plane = view.planes.at(x, y);
      EXPECT_GT(Eigen::Vector3d(plane.nx, plane.ny, plane.nz).dot(normal), 0.999);
      EXPECT_NEAR(plane.offset_m, -2, 0.01);  // normal . point: the wall is 2 m away
      const cv::Vec3b rgb = truth.rgb.at<cv::Vec3b>(y, x);
      difference +=
          std::abs(view.intensity.at(x, y) - (0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2]));
    }
  }
  EXPECT_LT(difference / (100 * 140), 3);  // grey levels; every second pixel is interpolated
}

TEST(Splatter, LeavesNoHolesFromNearAndFar) {
  MapFixture fixture;
  const RenderedRoom room = RenderedRoom::Wall(2);
  fixture.Fuse(room, LookAlong({0, 0, 0}, 0, 0));
  for (const double distance : {0.2, 0.0, -2.0}) {
    const auto pose = LookAlong({distance, 0, 0}, 0, 0);
    const ModelView view = fixture.Predict(pose, FullResolution());
    for (int y = 50; y < 70; ++y) {
      for (int x = 70; x < 90; ++x) EXPECT_GT(view.depth_m.at(x, y), 0) << distance;
    }
  }
}

TEST(Splatter, StableSurfelsHideUnstableOnesInFront) {
  MapFixture fixture;
  const auto pose = LookAlong({0, 0, 0}, 0, 0);
  for (int i = 0; i < 20; ++i) fixture.Fuse(RenderedRoom::Wall(2), pose);
  Surfel fly;
  fly.position_m = {1, 0, 0};
  fly.normal = {-1, 0, 0};
  fly.radius_m = 0.05F;
  fly.confidence = 1;
  fly.first_seen = fly.last_seen = fixture.map.frame();
  fixture.map.Insert(fly);
  EXPECT_NEAR(fixture.Predict(pose, FullResolution()).depth_m.at(80, 60), 2, kDepthTolerance);
}

TEST(Splatter, InactiveSurfelsAreNotDrawn) {
  MapFixture fixture;
  const auto pose = LookAlong({0, 0, 0}, 0, 0);
  fixture.Fuse(RenderedRoom::Wall(2), pose);
  const ModelView view = fixture.Predict(pose, FullResolution(), fixture.map.frame() + 1);
  EXPECT_EQ(view.depth_m.at(80, 60), 0);
}

TEST(Splatter, SurfelsSeenFromBehindAreNotDrawn) {
  MapFixture fixture;
  fixture.Fuse(RenderedRoom::Wall(2), LookAlong({0, 0, 0}, 0, 0));
  const ModelView view = fixture.Predict(LookAlong({4, 0, 0}, M_PI, 0), FullResolution());
  EXPECT_EQ(view.depth_m.at(80, 60), 0);
}

TEST(Splatter, SameBitsForAnyNumberOfThreads) {
  const auto pose = LookAlong({-1, 0, 0.2}, 0, 0.3);
  const auto predict = [&](int num_threads) {
    MapFixture fixture(num_threads);
    for (int i = 0; i < 4; ++i) fixture.Fuse(RenderedRoom::Furnished(), pose);
    return fixture.Predict(LookAlong({-0.9, 0.1, 0.25}, 0.1, 0.2));
  };
  const ModelView one = predict(1);
  const ModelView two = predict(2);
  const auto num_pixels = static_cast<std::size_t>(one.camera.width * one.camera.height);
  EXPECT_EQ(std::memcmp(one.depth_m.data(), two.depth_m.data(), num_pixels * sizeof(float)), 0);
  EXPECT_EQ(std::memcmp(one.intensity.data(), two.intensity.data(), num_pixels * sizeof(float)), 0);
  EXPECT_EQ(std::memcmp(one.planes.data(), two.planes.data(), num_pixels * sizeof(ModelPlane)), 0);
}

}  // namespace
}  // namespace posefusion
