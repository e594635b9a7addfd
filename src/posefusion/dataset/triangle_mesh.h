#pragma once

#include <Eigen/Core>
#include <vector>

namespace posefusion {

/// A surface of triangles in some map frame, metres. The order of a triangle's corners may tell its
/// outside (counter-clockwise seen from there); who reads a mesh decides whether it does.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3i> triangles;  ///< indices into `vertices`
};

}  // namespace posefusion
