#pragma once

#include "posefusion/evaluation/map_evaluation.h"
#include "test/support/rendered_room.h"

namespace posefusion {

constexpr float kRoomHalfM = 2;  ///< the sample room is a cube around the origin

/// Adds the rectangle from `corner` along the edges `u` and `v`.
inline void AddRectangle(const Eigen::Vector3f& corner, const Eigen::Vector3f& u,
                         const Eigen::Vector3f& v, TriangleMesh& mesh) {
  const auto first = static_cast<int>(mesh.vertices.size());
  for (const Eigen::Vector3f& vertex :
       std::initializer_list<Eigen::Vector3f>{corner, corner + u, corner + u + v, corner + v}) {
    mesh.vertices.push_back(vertex);
  }
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangles.emplace_back(first, first + 2, first + 3);
}

/// The six faces of the sample room.
inline TriangleMesh RoomMesh() {
  TriangleMesh mesh;
  for (const float side : {-kRoomHalfM, kRoomHalfM}) {
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3f corner = Eigen::Vector3f::Constant(-kRoomHalfM);
      corner[axis] = side;
      AddRectangle(corner, 2 * kRoomHalfM * Eigen::Vector3f::Unit((axis + 1) % 3),
                   2 * kRoomHalfM * Eigen::Vector3f::Unit((axis + 2) % 3), mesh);
    }
  }
  return mesh;
}

constexpr StampNs kRoomStartNs = 1'000'000'000;
constexpr StampNs kRoomPeriodNs = 33'333'333;

/// The sample room, and a camera that goes 20 cm along y in its middle, looking at the wall x = 2.
inline MapTruth RoomTruth() {
  MapTruth truth;
  truth.world = RoomMesh();
  truth.camera = testing::SmallCamera();
  for (int i = 0; i < 21; ++i) {
    truth.trajectory.push_back(
        {kRoomStartNs + i * kRoomPeriodNs, testing::LookAlong({0, -0.1 + 0.01 * i, 0}, 0, 0)});
  }
  return truth;
}

inline void AddSurfel(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                      SurfelCloud& map, StampNs seen_ns = kRoomStartNs, float radius_m = 0.005F) {
  map.position_m.push_back(position);
  map.normal.push_back(normal);
  map.rgb.push_back({0, 0, 0});
  map.radius_m.push_back(radius_m);
  map.confidence.push_back(20);
  map.first_seen_ns.push_back(seen_ns);
  map.last_seen_ns.push_back(seen_ns);
}

/// Surfels every 2 cm on the wall x = 2 + `offset_m` where min_y <= y <= max_y.
inline SurfelCloud WallMap(float offset_m, float min_y = -kRoomHalfM, float max_y = kRoomHalfM) {
  SurfelCloud map;
  for (float y = min_y + 0.01F; y < max_y; y += 0.02F) {
    for (float z = -kRoomHalfM + 0.01F; z < kRoomHalfM; z += 0.02F) {
      AddSurfel({kRoomHalfM + offset_m, y, z}, -Eigen::Vector3f::UnitX(), map);
    }
  }
  return map;
}

}  // namespace posefusion
