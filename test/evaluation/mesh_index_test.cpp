#include "posefusion/evaluation/mesh_index.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "test/evaluation/sample_room.h"

namespace posefusion {
namespace {

constexpr float kRounding = 2e-6F;  ///< of floats in a room of metres

/// Least distance from a million-point raster of the triangle: an upper bound, off by the raster.
float RasterDistance(const Eigen::Vector3f& p, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                     const Eigen::Vector3f& c) {
  constexpr int kSteps = 200;
  float least = 1e9F;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const float u = static_cast<float>(i) / kSteps;
      const float v = static_cast<float>(j) / kSteps;
      least = std::min(least, (a + u * (b - a) + v * (c - a) - p).norm());
    }
  }
  return least;
}

TEST(MeshIndex, TriangleDistanceEqualsTheRasterOfTheTriangle) {
  std::srand(3);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3f a = Eigen::Vector3f::Random();
    const Eigen::Vector3f b = Eigen::Vector3f::Random();
    const Eigen::Vector3f c = Eigen::Vector3f::Random();
    const Eigen::Vector3f p = 2 * Eigen::Vector3f::Random();
    const float raster = RasterDistance(p, a, b, c);
    EXPECT_LE(TriangleDistance(p, a, b, c), raster + kRounding);
    EXPECT_NEAR(TriangleDistance(p, a, b, c), raster, 0.02F);
  }
}

TEST(MeshIndex, TrianglesWithoutAreaAreLinesOrPoints) {
  const Eigen::Vector3f a(0, 0, 0);
  const Eigen::Vector3f b(2, 0, 0);
  EXPECT_FLOAT_EQ(TriangleDistance({1, 3, 0}, a, b, b), 3);
  EXPECT_FLOAT_EQ(TriangleDistance({1, 3, 0}, a, Eigen::Vector3f(1, 0, 0), b), 3);
  EXPECT_FLOAT_EQ(TriangleDistance({0, 3, 4}, a, a, a), 5);
}

TEST(MeshIndex, FindsTheNearestOfAllTriangles) {
  TriangleMesh mesh;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-3, 3);
  const auto point = [&] {
    const float x = coordinate(random);
    const float y = coordinate(random);
    return Eigen::Vector3f(x, y, coordinate(random));
  };
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3f corner = point();
    for (int k = 0; k < 3; ++k) mesh.vertices.emplace_back(corner + 0.2F * point());
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const MeshIndex index(mesh);
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3f p = 2 * point();
    float least = 1e9F;
    for (std::size_t t = 0; t < 300; ++t) {
      least = std::min(least, TriangleDistance(p, mesh.vertices[3 * t], mesh.vertices[3 * t + 1],
                                               mesh.vertices[3 * t + 2]));
    }
    EXPECT_NEAR(index.Distance(p), least, kRounding);
  }
}

TEST(MeshIndex, WallsHideWhatIsBehindThemButNotThemselves) {
  const MeshIndex room(RoomMesh());
  const Eigen::Vector3f inside(0, 0, 0);
  EXPECT_FALSE(room.IsHidden(inside, {1.9F, 1, 1}));
  EXPECT_FALSE(room.IsHidden(inside, {2, 0.3F, 0.7F}));
  EXPECT_TRUE(room.IsHidden(inside, {2.01F, 0.3F, 0.7F}));
  EXPECT_TRUE(room.IsHidden({5, 0.1F, 0}, inside));
  EXPECT_FALSE(room.IsHidden(inside, inside));
}

TEST(MeshIndex, RefusesAnEmptyMesh) {
  EXPECT_THROW(MeshIndex{TriangleMesh()}, std::invalid_argument);
}

}  // namespace
}  // namespace posefusion
