#pragma once

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "posefusion/simulation/light_bake.h"
#include "posefusion/simulation/world.h"

namespace posefusion {

/// Number of the immovable part among the bodies of a scene.
constexpr int kStaticBody = 0;

/// Something rigid with a mesh: the room, a thing, a part of a person.
struct RigidBody {
  const TriangleMesh* mesh = nullptr;
  std::uint8_t label = 0;
  int movable = -1;                           ///< number of the thing, or
  int person = -1, part = 0;                  ///< of the person and the part
  std::vector<Eigen::Vector3f> face_normals;  ///< unit, per triangle
  std::vector<float> repeats_per_m;           ///< of the texture, per triangle
  /// map <- body at the start, the middle and the end of the current interval.
  std::array<Eigen::Isometry3d, 3> T_map_body;
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();  ///< in the middle
  LightCube light{};                                       ///< that falls on it in the middle
};

/// A world as Embree sees it: one tree of the room, one for each part that moves, and a small one
/// above them that MoveTo() rebuilds. Not thread-safe while moving.
class RayScene {
 public:
  explicit RayScene(const World& world);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// Places all bodies for times from start to end; rays then take a time from 0 to 1 between
  /// them, and bodies move evenly on either side of the middle.
  void MoveTo(double start_s, double end_s);

  RTCScene top() const { return top_; }
  const std::vector<RigidBody>& bodies() const { return bodies_; }
  const std::vector<Eigen::Vector3f>& static_light() const { return static_light_; }
  const World& world() const { return world_; }

 private:
  RTCScene AddTree(const TriangleMesh& mesh);
  void AddBody(const TriangleMesh& mesh, int label, int movable, int person, int part);
  Eigen::Isometry3d PoseOf(const RigidBody& body, const std::vector<PersonPose>& people,
                           double time_s) const;
  void BakeStaticLight();
  void Attach(std::size_t body, bool moves);

  const World& world_;
  RTCDevice device_;
  RTCScene top_;
  std::vector<RTCScene> trees_;
  std::vector<RTCGeometry> instances_;
  std::vector<RigidBody> bodies_;
  std::vector<Eigen::Vector3f> static_light_;  ///< irradiance at the room's vertices
  std::unique_ptr<LightBake> bake_;
};

}  // namespace posefusion
