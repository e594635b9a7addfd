#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "posefusion/dataset/triangle_mesh.h"
#include "posefusion/simulation/head_motion.h"
#include "posefusion/simulation/person.h"

namespace posefusion {

struct Material;
struct AreaLight;

enum class RoomKind {
  /// One furnished room: x in [-3, 3], y in [-2.5, 2.5], 2.6 m high. A table (1.5 x 0.8 m) with
  /// chairs stands in the middle, furniture of at most 0.45 m depth along the walls: both a loop of
  /// 1.55 x 1.25 m half axes around the table and a rectangle of +-2.15 x +-1.65 m are free.
  kLab,
  /// A corridor (x in [0, 26], y in [-1, 1]) with rooms on both sides; CorridorRoute() leads
  /// through all of it and back.
  kCorridor,
};

/// Floor boxes (map x, y in metres) of everything that one cannot walk through, walls included.
std::vector<Eigen::AlignedBox2d> FloorObstacles(RoomKind room);

/// Corners of a way without collisions through corridor and rooms and back to its start, >= 60 m.
std::vector<Eigen::Vector2d> CorridorRoute();

/// An object that somebody moves once: it rests before from_s and after to_s.
struct MovedObject {
  int movable;  ///< number in the World
  std::string name;
  double from_s;
  double to_s;
  Eigen::Vector3d offset_m;  ///< map frame
};

/// A time in which somebody is to come into the view of the camera, which lies on the floor.
struct CameraVisit {
  double from_s;
  double to_s;
};

struct WorldConfig {
  RoomKind room = RoomKind::kLab;
  int humans = 0;       ///< 0 to 6
  int seed = 1;         ///< of clothing, bodies and what people do
  double seconds = 60;  ///< how long people are given things to do; they rest afterwards
  /// The camera's way, when known: people cross in front of it and do not walk into it. May be
  /// null.
  std::shared_ptr<const HeadMotion> head;
  /// Places on the floor where nobody stands for long (the robot's way when `head` is null).
  std::vector<Eigen::Vector2d> keep_clear;
  std::vector<CameraVisit> visits;  ///< in order of time; only with `head`
};

/// Rooms, things and people. Immutable after construction; every time-dependent value is a pure
/// function of time, so all members are thread-safe. Map frame: z up, floor at z = 0, metres.
class World {
 public:
  /// @throws std::invalid_argument naming the field that is out of range.
  explicit World(const WorldConfig& config);
  ~World();
  World(World&&) noexcept;

  const WorldConfig& config() const;

  /// Everything that nobody can move, in the map frame.
  const TriangleMesh& static_mesh() const;
  const std::vector<Eigen::AlignedBox2d>& obstacles() const;
  const std::vector<Material>& materials() const;  ///< by the numbers in meshes
  const std::vector<AreaLight>& lights() const;

  int num_people() const;
  PersonPose PersonAt(int person, double time_s) const;
  /// Mesh of a body part in the part's own frame.
  const TriangleMesh& part_mesh(int person, BodyPart part) const;

  /// Things that may be moved, in their own frames.
  int num_movables() const;
  const TriangleMesh& movable_mesh(int movable) const;
  Eigen::Isometry3d T_map_movable(int movable, double time_s) const;
  /// Those that are moved before config().seconds; what a person pushes comes first.
  std::vector<MovedObject> moved_objects() const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

}  // namespace posefusion
