#include "posefusion/evaluation/true_surfaces.h"

#include <algorithm>
#include <limits>

namespace posefusion {
namespace {

constexpr StampNs kFirstNs = std::numeric_limits<StampNs>::min();
constexpr StampNs kLastNs = std::numeric_limits<StampNs>::max();

}  // namespace

TrueSurfaces::TrueSurfaces(const TriangleMesh& world, const std::vector<MovedSurfaces>& moved)
    : world_(world) {
  for (const MovedSurfaces& object : moved) {
    if (!object.before.triangles.empty()) {
      passing_.push_back({kFirstNs, object.begin_ns, MeshIndex(object.before)});
    }
    if (!object.after.triangles.empty()) {
      passing_.push_back({object.end_ns, kLastNs, MeshIndex(object.after)});
    }
  }
}

float TrueSurfaces::Distance(const Eigen::Vector3f& point, StampNs stamp_ns) const {
  float distance = world_.Distance(point);
  for (const Passing& surface : passing_) {
    if (stamp_ns < surface.begin_ns || stamp_ns > surface.end_ns) continue;
    distance = std::min(distance, surface.mesh.Distance(point));
  }
  return distance;
}

}  // namespace posefusion
