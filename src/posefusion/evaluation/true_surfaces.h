#pragma once

#include <vector>

#include "posefusion/dataset/moved_objects_file.h"
#include "posefusion/evaluation/mesh_index.h"

namespace posefusion {

/// The surfaces of a world in which things are moved. Questions may come from several threads.
class TrueSurfaces {
 public:
  /// @throws std::invalid_argument when the world has no triangles.
  TrueSurfaces(const TriangleMesh& world, const std::vector<MovedSurfaces>& moved);

  /// What is not moved.
  const MeshIndex& world() const { return world_; }

  /// Distance of a point from the nearest surface that rested at its place at that moment, metres.
  float Distance(const Eigen::Vector3f& point, StampNs stamp_ns) const;

 private:
  /// A surface that is there for a part of the time; both ends belong to it.
  struct Passing {
    StampNs begin_ns;
    StampNs end_ns;
    MeshIndex mesh;
  };

  MeshIndex world_;
  std::vector<Passing> passing_;
};

}  // namespace posefusion
