#include "posefusion/simulation/light_bake.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace posefusion {
namespace {

using Eigen::Vector3f;

constexpr float kOffset = 0.02F;     // rays start off the surface, so that pictures on a wall
                                     // do not darken it around them
constexpr float kLightReach = 9.0F;  // metres; weaker lights are left out
constexpr float kAmbient = 0.62F;    // radiance of a white surface of the room
constexpr int kDirections = 32;

RTCRay MakeRay(const Vector3f& from, const Vector3f& direction, float length) {
  RTCRay ray{};
  ray.org_x = from.x();
  ray.org_y = from.y();
  ray.org_z = from.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = length;
  ray.mask = 0xffffffffU;
  return ray;
}

/// Direction i of kDirections, spread over the hemisphere around z by the cosine (Fibonacci
/// spiral).
Vector3f SpreadDirection(int i) {
  const float share = (static_cast<float>(i) + 0.5F) / kDirections;
  const float angle = static_cast<float>(i) * 2.3999632F;
  const float radius = std::sqrt(share);
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - share)};
}

}  // namespace

LightBake::LightBake(RTCScene scene, const TriangleMesh& mesh,
                     const std::vector<Material>& materials, const std::vector<AreaLight>& lights)
    : scene_(scene), mesh_(mesh), lights_(lights) {
  for (const Material& material : materials) {
    const Rgb4 mean = material.texture.Mean();
    reflectance_.emplace_back(mean[0], mean[1], mean[2]);
  }
}

bool LightBake::IsVisible(const Vector3f& from, const Vector3f& to) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = MakeRay(from, to - from, 0.995F);
  rtcOccluded1(scene_, &context, &ray);
  return ray.tfar >= 0;
}

Vector3f LightBake::Direct(const Vector3f& p, const Vector3f& normal) const {
  constexpr int kSide = 3;  // samples along each edge of a light
  Vector3f sum = Vector3f::Zero();
  for (const AreaLight& light : lights_) {
    const Vector3f center = light.center.cast<float>();
    if ((center - p).norm() > kLightReach) continue;
    const Vector3f light_normal = light.normal.cast<float>();
    const auto area = static_cast<float>(4 * light.half_u.norm() * light.half_v.norm());
    for (int i = 0; i < kSide * kSide; ++i) {
      const float s = 2 * (static_cast<float>(i % kSide) + 0.5F) / kSide - 1;
      const float t = 2 * (static_cast<float>(i / kSide) + 0.5F) / kSide - 1;
      const Vector3f at = center + s * light.half_u.cast<float>() + t * light.half_v.cast<float>();
      const Vector3f to_light = at - p;
      const float squared = std::max(to_light.squaredNorm(), 0.04F);
      const float cosines = normal.dot(to_light) * -light_normal.dot(to_light) / squared;
      if (cosines <= 0 || normal.dot(to_light) <= 0 || !IsVisible(p, at)) continue;
      sum += light.radiance * (cosines * area / (kSide * kSide * squared * 3.14159F));
    }
  }
  return sum;
}

Vector3f LightBake::Reflected(const Vector3f& p, const Vector3f& normal) const {
  const Vector3f helper = std::abs(normal.z()) < 0.9F ? Vector3f::UnitZ() : Vector3f::UnitX();
  const Vector3f side = helper.cross(normal).normalized();
  const Vector3f other = normal.cross(side);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  Vector3f sum = Vector3f::Zero();
  for (int i = 0; i < kDirections; ++i) {
    const Vector3f local = SpreadDirection(i);
    RTCRayHit ray{};
    ray.ray = MakeRay(p, local.x() * side + local.y() * other + local.z() * normal, 20.0F);
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    // Near surfaces lie in the shade of this one: corners get darker.
    const float openness = std::min(ray.ray.tfar / 0.8F, 1.0F);
    sum += reflectance_[mesh_.materials[ray.hit.primID]] * (0.25F + 0.75F * openness);
  }
  return sum * (kAmbient / kDirections);
}

Vector3f LightBake::Irradiance(const Vector3f& p_map, const Vector3f& normal) const {
  const Vector3f start = p_map + kOffset * normal;
  return Direct(start, normal) + Reflected(start, normal);
}

LightCube LightBake::CubeAt(const Vector3f& p_map) const {
  LightCube cube;
  for (int i = 0; i < 6; ++i) {
    Vector3f normal = Vector3f::Zero();
    normal[i / 2] = i % 2 == 0 ? 1.0F : -1.0F;
    cube[static_cast<std::size_t>(i)] = Direct(p_map, normal) + Reflected(p_map, normal);
  }
  return cube;
}

}  // namespace posefusion
