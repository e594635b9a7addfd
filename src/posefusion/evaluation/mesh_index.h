#pragma once

#include <Eigen/Core>
#include <memory>

#include "posefusion/dataset/triangle_mesh.h"

namespace posefusion {

/// Answers how far points are from a mesh and what hides them (Embree). Both sides of a triangle
/// count. Questions may come from several threads at once.
class MeshIndex {
 public:
  /// @throws std::invalid_argument when the mesh has no triangles.
  explicit MeshIndex(const TriangleMesh& mesh);
  ~MeshIndex();
  MeshIndex(MeshIndex&&) noexcept;
  MeshIndex& operator=(MeshIndex&&) noexcept;

  /// Distance of a point from the nearest triangle, metres.
  float Distance(const Eigen::Vector3f& point) const;

  /// Whether a triangle crosses the line between two points. The last 5 mm before `to` do not
  /// count, since `to` is meant to lie on the mesh itself.
  bool IsHidden(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

/// Distance of a point from a triangle, which may be a line or a point.
float TriangleDistance(const Eigen::Vector3f& point, const Eigen::Vector3f& a,
                       const Eigen::Vector3f& b, const Eigen::Vector3f& c);

}  // namespace posefusion
