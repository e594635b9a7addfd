#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace posefusion {

/// A surface of triangles in some map frame, metres. The order of a triangle's corners may tell its
/// outside (counter-clockwise seen from there); who reads a mesh decides whether it does.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3i> triangles;  ///< indices into `vertices`

  // What a renderer wants besides; empty in meshes from files.
  std::vector<Eigen::Vector3f> normals;  ///< unit, per vertex, on the visible side
  std::vector<Eigen::Vector2f> uv;       ///< per vertex, in repeats of the texture
  std::vector<std::uint8_t> materials;   ///< per triangle, number of a Material
};

}  // namespace posefusion
