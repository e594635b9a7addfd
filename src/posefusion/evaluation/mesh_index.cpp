#include "posefusion/evaluation/mesh_index.h"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>

namespace posefusion {
namespace {

constexpr float kEndMarginM = 0.005F;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float SegmentDistance(const Eigen::Vector3f& point, const Eigen::Vector3f& a,
                      const Eigen::Vector3f& b) {
  const Eigen::Vector3f direction = b - a;
  const float square = direction.squaredNorm();
  const float along = square > 0 ? (point - a).dot(direction) / square : 0;
  return (point - a - std::clamp(along, 0.0F, 1.0F) * direction).norm();
}

void CopyMesh(const TriangleMesh& mesh, RTCGeometry geometry) {
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices.size()));
  auto* triangles = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), mesh.triangles.size()));
  if (vertices == nullptr || triangles == nullptr) {
    throw std::runtime_error("Embree has no memory for the mesh");
  }
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    vertices = std::copy_n(vertex.data(), 3, vertices);
  }
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (const int corner : triangle) *triangles++ = static_cast<unsigned>(corner);
  }
}

/// What a search for the nearest triangle looks at.
struct Search {
  const TriangleMesh& mesh;
  Eigen::Vector3f point;
};

/// Shrinks the search's radius to the distance of a triangle that is nearer.
bool VisitTriangle(RTCPointQueryFunctionArguments* arguments) {
  const Search& search = *static_cast<const Search*>(arguments->userPtr);
  const Eigen::Vector3i& corners = search.mesh.triangles[arguments->primID];
  const auto vertex = [&](int i) -> const Eigen::Vector3f& {
    return search.mesh.vertices[static_cast<std::size_t>(corners[i])];
  };
  const float distance = TriangleDistance(search.point, vertex(0), vertex(1), vertex(2));
  if (distance >= arguments->query->radius) return false;
  arguments->query->radius = distance;
  return true;
}

}  // namespace

float TriangleDistance(const Eigen::Vector3f& point, const Eigen::Vector3f& a,
                       const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  const Eigen::Vector3f normal = (b - a).cross(c - a);
  // Inside the prism over the triangle when the point is on the inner side of every edge.
  const auto is_inside = [&](const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
    return (to - from).cross(point - from).dot(normal) >= 0;
  };
  const float length = normal.norm();
  if (length > 0 && is_inside(a, b) && is_inside(b, c) && is_inside(c, a)) {
    return std::abs((point - a).dot(normal)) / length;
  }
  return std::min(
      {SegmentDistance(point, a, b), SegmentDistance(point, b, c), SegmentDistance(point, c, a)});
}

struct MeshIndex::Scene {
  explicit Scene(const TriangleMesh& m) : mesh(m) {}
  ~Scene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }

  TriangleMesh mesh;
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = rtcNewScene(device);
};

MeshIndex::MeshIndex(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) throw std::invalid_argument("mesh has no triangles");
  scene_ = std::make_unique<Scene>(mesh);
  RTCGeometry geometry = rtcNewGeometry(scene_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  CopyMesh(mesh, geometry);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(scene_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(scene_->scene);
}

MeshIndex::~MeshIndex() = default;
MeshIndex::MeshIndex(MeshIndex&&) noexcept = default;
MeshIndex& MeshIndex::operator=(MeshIndex&&) noexcept = default;

float MeshIndex::Distance(const Eigen::Vector3f& point) const {
  RTCPointQuery query{point.x(), point.y(), point.z(), 0, kInfinity};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  Search search{scene_->mesh, point};
  rtcPointQuery(scene_->scene, &query, &context, VisitTriangle, &search);
  return query.radius;
}

bool MeshIndex::IsHidden(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const {
  const Eigen::Vector3f way = to - from;
  const float length = way.norm();
  if (length <= kEndMarginM) return false;
  const Eigen::Vector3f direction = way / length;
  RTCRay ray{};
  ray.org_x = from.x();
  ray.org_y = from.y();
  ray.org_z = from.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = length - kEndMarginM;
  ray.mask = ~0U;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_->scene, &context, &ray);
  return ray.tfar < 0;  // Embree's sign for a hit
}

}  // namespace posefusion
