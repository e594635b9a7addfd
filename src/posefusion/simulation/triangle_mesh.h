#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace posefusion {

/// Textured triangles. Metres, in the frame that the owner names.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;    ///< unit, per vertex, on the visible side
  std::vector<Eigen::Vector2f> uv;         ///< per vertex, in repeats of the texture
  std::vector<Eigen::Vector3i> triangles;  ///< vertex numbers
  std::vector<std::uint8_t> materials;     ///< per triangle, number of a Material
};

}  // namespace posefusion
