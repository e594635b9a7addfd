#include "posefusion/simulation/world.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "posefusion/simulation/body.h"
#include "posefusion/simulation/choreography.h"
#include "posefusion/simulation/furniture.h"
#include "posefusion/simulation/material.h"
#include "posefusion/simulation/mesh_builder.h"
#include "posefusion/simulation/room_plan.h"

namespace posefusion {
namespace {

constexpr int kMaxHumans = 6;

const WorldConfig& Checked(const WorldConfig& config) {
  if (config.humans < 0 || config.humans > kMaxHumans) {
    throw std::invalid_argument("world.humans: " + std::to_string(config.humans) +
                                " is not in [0, " + std::to_string(kMaxHumans) + "]");
  }
  if (!(config.seconds > 0) || config.seconds > 1e5) {
    throw std::invalid_argument("world.seconds: " + std::to_string(config.seconds) +
                                " is not in (0, 100000]");
  }
  return config;
}

TriangleMesh ObjectMesh(const std::string& name) {
  MeshBuilder mesh;
  const auto origin = Eigen::Isometry3d::Identity();
  if (name == "chair") furniture::AddChair(mesh, origin, kSeatBlue);
  if (name == "backpack") furniture::AddBackpack(mesh, origin);
  if (name == "box") furniture::AddCardboardBox(mesh, origin, {0.42, 0.34, 0.32});
  return mesh.Take();
}

}  // namespace

struct World::Content {
  explicit Content(const WorldConfig& given)
      : config(Checked(given)),
        plan(MakeRoomPlan(given.room)),
        materials(MakeMaterials(given.humans, given.seed)),
        choreography(MakeChoreography(config, plan)) {
    for (const auto& object : plan.objects) objects.push_back(ObjectMesh(object.name));
    for (int i = 0; i < config.humans; ++i) {
      bodies.push_back(BodyMeshes(choreography.shapes[static_cast<std::size_t>(i)], i));
    }
  }

  WorldConfig config;
  RoomPlan plan;
  std::vector<Material> materials;
  Choreography choreography;
  std::vector<TriangleMesh> objects;
  std::vector<std::array<TriangleMesh, kNumBodyParts>> bodies;
};

std::vector<Eigen::AlignedBox2d> FloorObstacles(RoomKind room) {
  return MakeRoomPlan(room).obstacles;
}

std::vector<Eigen::Vector2d> CorridorRoute() {
  const std::vector<Eigen::Vector2d> loop{{1.6, -1.35}, {1.7, 1.4}, {-1.7, 1.4}, {-1.6, -1.35}};
  std::vector<Eigen::Vector2d> route{{3.0, 1.9}};
  const auto visit = [&](double x, double y, double sign) {
    route.emplace_back(x, 0.1 * sign);
    route.emplace_back(x, y - 1.7 * sign);
    for (const auto& corner : loop) {
      route.emplace_back(x + sign * corner.x(), y + sign * corner.y());
    }
    route.emplace_back(x, y - 1.7 * sign);
    route.emplace_back(x, 0.1 * sign);
  };
  visit(3.0, 3.6, 1);
  visit(11.0, -3.6, -1);
  visit(20.0, 3.6, 1);
  for (const double x : {24.8, 1.4, 3.0}) route.emplace_back(x, 0.1);
  route.emplace_back(3.0, 1.9);
  return route;
}

World::World(const WorldConfig& config) : content_(std::make_unique<Content>(config)) {}
World::~World() = default;
World::World(World&&) noexcept = default;

const WorldConfig& World::config() const { return content_->config; }
const TriangleMesh& World::static_mesh() const { return content_->plan.mesh; }
const std::vector<Material>& World::materials() const { return content_->materials; }
const std::vector<AreaLight>& World::lights() const { return content_->plan.lights; }
const std::vector<Eigen::AlignedBox2d>& World::obstacles() const {
  return content_->plan.obstacles;
}

int World::num_people() const { return content_->config.humans; }

PersonPose World::PersonAt(int person, double time_s) const {
  return content_->choreography.people.at(static_cast<std::size_t>(person)).At(time_s);
}

const TriangleMesh& World::part_mesh(int person, BodyPart part) const {
  return content_->bodies.at(static_cast<std::size_t>(person))[part];
}

int World::num_movables() const { return static_cast<int>(content_->objects.size()); }

const TriangleMesh& World::movable_mesh(int movable) const {
  return content_->objects.at(static_cast<std::size_t>(movable));
}

Eigen::Isometry3d World::T_map_movable(int movable, double time_s) const {
  const auto index = static_cast<std::size_t>(movable);
  const PlannedMove& object = content_->plan.objects.at(index);
  const Choreography::Move& move = content_->choreography.moves.at(index);
  if (!move.happens) return object.from;
  const double duration = move.to_s - move.from_s;
  const double share = WalkedShare((time_s - move.from_s) / duration, duration);
  Eigen::Isometry3d T = object.from;
  T.translation() += share * (object.to.translation() - object.from.translation());
  return T;
}

std::vector<MovedObject> World::moved_objects() const {
  std::vector<MovedObject> moved;
  for (std::size_t i = 0; i < content_->plan.objects.size(); ++i) {
    const Choreography::Move& move = content_->choreography.moves[i];
    const PlannedMove& object = content_->plan.objects[i];
    if (!move.happens || move.from_s >= content_->config.seconds) continue;
    moved.push_back({static_cast<int>(i), object.name, move.from_s, move.to_s,
                     object.to.translation() - object.from.translation()});
  }
  return moved;
}

}  // namespace posefusion
