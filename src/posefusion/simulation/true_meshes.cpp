#include "posefusion/simulation/true_meshes.h"

#include <algorithm>

#include "posefusion/simulation/simulator.h"

namespace posefusion {
namespace {

/// Adds the bare surface of a mesh in its own frame.
void AddSurface(const TriangleMesh& own, const Eigen::Isometry3d& T_map_own, TriangleMesh& mesh) {
  const auto first = static_cast<int>(mesh.vertices.size());
  const Eigen::Isometry3f T = T_map_own.cast<float>();
  for (const Eigen::Vector3f& vertex : own.vertices) mesh.vertices.push_back(T * vertex);
  for (const Eigen::Vector3i& triangle : own.triangles) {
    mesh.triangles.emplace_back(triangle.array() + first);
  }
}

TriangleMesh MovableAt(const World& world, int movable, double time_s) {
  TriangleMesh mesh;
  AddSurface(world.movable_mesh(movable), world.T_map_movable(movable, time_s), mesh);
  return mesh;
}

}  // namespace

TriangleMesh UnmovedSurfaces(const World& world) {
  const auto moved = world.moved_objects();
  TriangleMesh mesh;
  AddSurface(world.static_mesh(), Eigen::Isometry3d::Identity(), mesh);
  for (int i = 0; i < world.num_movables(); ++i) {
    const auto is_this = [i](const MovedObject& object) { return object.movable == i; };
    if (std::any_of(moved.begin(), moved.end(), is_this)) continue;
    AddSurface(world.movable_mesh(i), world.T_map_movable(i, 0), mesh);
  }
  return mesh;
}

std::vector<MovedSurfaces> MovedSurfacesOf(const World& world) {
  std::vector<MovedSurfaces> surfaces;
  for (const MovedObject& object : world.moved_objects()) {
    surfaces.push_back({object.name, SimulationStamp(object.from_s), SimulationStamp(object.to_s),
                        object.offset_m, MovableAt(world, object.movable, object.from_s),
                        MovableAt(world, object.movable, object.to_s)});
  }
  return surfaces;
}

}  // namespace posefusion
