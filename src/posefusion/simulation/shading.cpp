#include "posefusion/simulation/shading.h"

#include <algorithm>
#include <cmath>

#include "posefusion/simulation/material.h"

namespace posefusion {
namespace {

using Eigen::Vector3f;

/// Weighted mean of a value of a triangle's three corners.
template <class Values>
auto AtHit(const Values& values, const Eigen::Vector3i& triangle, const Hit& hit) {
  const auto& a = values[static_cast<std::size_t>(triangle[0])];
  const auto& b = values[static_cast<std::size_t>(triangle[1])];
  const auto& c = values[static_cast<std::size_t>(triangle[2])];
  return (a * (1 - hit.u - hit.v) + b * hit.u + c * hit.v).eval();
}

Vector3f FromCube(const LightCube& cube, const Vector3f& normal) {
  Vector3f light = Vector3f::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const auto side = static_cast<std::size_t>(2 * axis + (normal[axis] < 0 ? 1 : 0));
    light += cube[side] * (normal[axis] * normal[axis]);
  }
  return light;
}

const Vector3f& FaceNormal(const RigidBody& body, const Hit& hit) {
  return body.face_normals[static_cast<std::size_t>(hit.triangle)];
}

const Material& MaterialOf(const RayScene& scene, const RigidBody& body, const Hit& hit) {
  return scene.world().materials()[body.mesh->materials[static_cast<std::size_t>(hit.triangle)]];
}

Vector3f LightAt(const RayScene& scene, const RigidBody& body, const Eigen::Vector3i& triangle,
                 const Hit& hit) {
  if (hit.body == kStaticBody) return AtHit(scene.static_light(), triangle, hit);
  const Vector3f normal = body.rotation * AtHit(body.mesh->normals, triangle, hit);
  return FromCube(body.light, normal.normalized());
}

}  // namespace

Rgb4 Radiance(const RayScene& scene, const Hit& hit, float incidence_cosine, float pixel_rad) {
  const RigidBody& body = scene.bodies()[static_cast<std::size_t>(hit.body)];
  const Eigen::Vector3i& triangle = body.mesh->triangles[static_cast<std::size_t>(hit.triangle)];
  const Material& material = MaterialOf(scene, body, hit);
  const Eigen::Vector2f uv = AtHit(body.mesh->uv, triangle, hit);
  // A pixel covers this much of the surface: the geometric mean of across and along the slope.
  const float cosine = std::max(incidence_cosine, 0.05F);
  const float width_m = hit.depth_m * pixel_rad / std::sqrt(cosine);
  const float density = body.repeats_per_m[static_cast<std::size_t>(hit.triangle)];
  const Rgb4 color = material.texture.Sample(uv.x(), uv.y(), width_m * density);
  const Vector3f light = LightAt(scene, body, triangle, hit);
  const float glow = material.emission;
  return color * Rgb4{light.x() + glow, light.y() + glow, light.z() + glow, 0};
}

float IncidenceCosine(const RayScene& scene, const Hit& hit, const Vector3f& direction) {
  const RigidBody& body = scene.bodies()[static_cast<std::size_t>(hit.body)];
  const Vector3f& normal = FaceNormal(body, hit);
  const float along =
      hit.body == kStaticBody ? normal.dot(direction) : (body.rotation * normal).dot(direction);
  return std::abs(along) / direction.norm();
}

float InfraredReflectance(const RayScene& scene, const Hit& hit) {
  return MaterialOf(scene, scene.bodies()[static_cast<std::size_t>(hit.body)], hit).infrared;
}

}  // namespace posefusion
