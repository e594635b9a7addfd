#include "posefusion/simulation/ray_scene.h"

#include <tbb/task_arena.h>

#include <cmath>
#include <stdexcept>

#include "posefusion/simulation/renderer.h"

namespace posefusion {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3f;

/// Unit normals and texture densities of a body's triangles.
void MeasureFaces(RigidBody& body) {
  const TriangleMesh& mesh = *body.mesh;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const auto vertex = [&](int i) { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
    const auto uv = [&](int i) { return mesh.uv[static_cast<std::size_t>(t[i])]; };
    Vector3f normal = (vertex(1) - vertex(0)).cross(vertex(2) - vertex(0));
    const float area = normal.norm();
    if (normal.dot(mesh.normals[static_cast<std::size_t>(t[0])]) < 0) normal = -normal;
    const Eigen::Vector2f a = uv(1) - uv(0);
    const Eigen::Vector2f b = uv(2) - uv(0);
    const float uv_area = std::abs(a.x() * b.y() - a.y() * b.x());
    body.face_normals.push_back(area > 0 ? (normal / area).eval() : Vector3f::UnitZ());
    body.repeats_per_m.push_back(area > 0 ? std::sqrt(uv_area / area) : 1.0F);
  }
}

void SetTransform(RTCGeometry instance, unsigned step, const Isometry3d& T) {
  const Eigen::Matrix<float, 3, 4> matrix = T.matrix().topRows<3>().cast<float>();
  rtcSetGeometryTransform(instance, step, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix.data());
}

/// Builds a tree on one thread, so that it, and which of two equally near triangles a ray meets,
/// does not depend on the number of threads. (Embree's own setting for this would hold for all of
/// the program's TBB loops.)
void Commit(RTCScene scene) {
  tbb::task_arena single(1);
  single.execute([scene] { rtcCommitScene(scene); });
}

}  // namespace

RayScene::RayScene(const World& world) : world_(world) {
  device_ = rtcNewDevice(nullptr);
  if (device_ == nullptr) throw std::runtime_error("Embree: no device");
  top_ = rtcNewScene(device_);
  rtcSetSceneFlags(top_, RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST);
  AddBody(world.static_mesh(), kLabelStatic, -1, -1, 0);
  for (int i = 0; i < world.num_movables(); ++i) {
    AddBody(world.movable_mesh(i), kLabelMovable, i, -1, 0);
  }
  for (int i = 0; i < world.num_people(); ++i) {
    for (int part = 0; part < kNumBodyParts; ++part) {
      AddBody(world.part_mesh(i, static_cast<BodyPart>(part)), kLabelPerson + i, -1, i, part);
    }
  }
  BakeStaticLight();
  MoveTo(0, 0);
}

RayScene::~RayScene() {
  for (RTCGeometry instance : instances_) rtcReleaseGeometry(instance);
  for (RTCScene tree : trees_) rtcReleaseScene(tree);
  rtcReleaseScene(top_);
  rtcReleaseDevice(device_);
}

RTCScene RayScene::AddTree(const TriangleMesh& mesh) {
  RTCScene tree = rtcNewScene(device_);
  rtcSetSceneFlags(tree, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(tree, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices.size()));
  for (const Vector3f& vertex : mesh.vertices) {
    for (int i = 0; i < 3; ++i) *vertices++ = vertex[i];
  }
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), mesh.triangles.size()));
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) *indices++ = static_cast<unsigned>(triangle[i]);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tree, geometry);
  rtcReleaseGeometry(geometry);
  Commit(tree);
  return tree;
}

void RayScene::AddBody(const TriangleMesh& mesh, int label, int movable, int person, int part) {
  RigidBody body;
  body.mesh = &mesh;
  body.label = static_cast<std::uint8_t>(label);
  body.movable = movable;
  body.person = person;
  body.part = part;
  body.T_map_body.fill(Isometry3d::Identity());
  MeasureFaces(body);
  bodies_.push_back(std::move(body));
  trees_.push_back(AddTree(mesh));
  RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, trees_.back());
  SetTransform(instance, 0, Isometry3d::Identity());
  rtcCommitGeometry(instance);
  rtcAttachGeometryByID(top_, instance, static_cast<unsigned>(bodies_.size() - 1));
  instances_.push_back(instance);
}

void RayScene::BakeStaticLight() {
  const TriangleMesh& mesh = world_.static_mesh();
  bake_ = std::make_unique<LightBake>(trees_.front(), mesh, world_.materials(), world_.lights());
  static_light_.reserve(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    static_light_.push_back(bake_->Irradiance(mesh.vertices[i], mesh.normals[i]));
  }
}

Isometry3d RayScene::PoseOf(const RigidBody& body, const std::vector<PersonPose>& people,
                            double time_s) const {
  if (body.movable >= 0) return world_.T_map_movable(body.movable, time_s);
  const PersonPose& pose = people[static_cast<std::size_t>(body.person)];
  return pose.T_map_part[static_cast<std::size_t>(body.part)];
}

void RayScene::MoveTo(double start_s, double end_s) {
  for (std::size_t step = 0; step < 3; ++step) {
    const double time_s = start_s + 0.5 * static_cast<double>(step) * (end_s - start_s);
    std::vector<PersonPose> people;
    for (int i = 0; i < world_.num_people(); ++i) people.push_back(world_.PersonAt(i, time_s));
    for (std::size_t i = 1; i < bodies_.size(); ++i) {
      bodies_[i].T_map_body[step] = PoseOf(bodies_[i], people, time_s);
    }
  }
  for (std::size_t i = 1; i < bodies_.size(); ++i) Attach(i, end_s > start_s);
  Commit(top_);
}

void RayScene::Attach(std::size_t index, bool moves) {
  RigidBody& body = bodies_[index];
  RTCGeometry instance = instances_[index];
  rtcSetGeometryTimeStepCount(instance, moves ? 3 : 1);
  if (moves) {
    for (unsigned step = 0; step < 3; ++step) SetTransform(instance, step, body.T_map_body[step]);
  } else {
    SetTransform(instance, 0, body.T_map_body[1]);
  }
  rtcCommitGeometry(instance);
  body.rotation = body.T_map_body[1].linear().cast<float>();
  // One cube of light for a whole person, at the chest: cheap, and light is even in a room.
  const bool is_first = body.movable >= 0 || body.part == 0;
  if (!is_first) {
    body.light = bodies_[index - 1].light;
    return;
  }
  const double up = body.movable >= 0 ? 0.3 : 0.25;
  const Eigen::Vector3d place = body.T_map_body[1].translation() + Eigen::Vector3d(0, 0, up);
  body.light = bake_->CubeAt(place.cast<float>());
}

}  // namespace posefusion
