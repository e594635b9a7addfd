#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "posefusion/dataset/triangle_mesh.h"
#include "posefusion/simulation/world.h"

namespace posefusion {

/// Where somebody can sit: on the floor below the seat's middle, facing along the pose's x axis.
struct Seat {
  Eigen::Vector2d position;
  double yaw_rad;
  Eigen::Vector2d beside;  ///< free place next to it, from where one sits down
};

/// A lamp or window that gives light: a rectangle and its radiance.
struct AreaLight {
  Eigen::Vector3d center;
  Eigen::Vector3d half_u;
  Eigen::Vector3d half_v;
  Eigen::Vector3d normal;
  Eigen::Vector3f radiance;
};

/// A thing that is moved once. Poses take the thing's points to the map.
struct PlannedMove {
  std::string name;
  Eigen::Isometry3d from;
  Eigen::Isometry3d to;
};

/// The immovable part of a world and what has to be known about it.
struct RoomPlan {
  TriangleMesh mesh;
  std::vector<Eigen::AlignedBox2d> obstacles;
  std::vector<Seat> seats;
  std::vector<Eigen::Vector2d> places;   ///< free places where people like to stand
  std::vector<Eigen::Vector2d> outside;  ///< places out of sight, for people who leave
  std::vector<PlannedMove> objects;  ///< what will be moved; the first one is pushed by a person
  Eigen::AlignedBox2d floor;
  std::vector<AreaLight> lights;
};

RoomPlan MakeRoomPlan(RoomKind room);

}  // namespace posefusion
