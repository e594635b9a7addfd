#include "posefusion/segmentation/pixel_rays.h"

namespace posefusion {
namespace {

constexpr int kInverseIterations = 12;  ///< to 1e-4 px in the corners of a Kinect's image

/// The plumb_bob model: the ray (x / z, y / z) that the lens bends `ray` to.
Eigen::Vector2d Distort(const CameraModel& camera, const Eigen::Vector2d& ray) {
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double x = ray.x();
  const double y = ray.y();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
          y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

}  // namespace

Eigen::Vector2d RayOf(const CameraModel& camera, double u, double v) {
  const Eigen::Vector2d distorted((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy);
  if (!camera.HasDistortion()) return distorted;
  Eigen::Vector2d ray = distorted;
  for (int i = 0; i < kInverseIterations; ++i) ray += distorted - Distort(camera, ray);
  return ray;
}

Eigen::Vector2d DistortedPixelOf(const CameraModel& camera, const Eigen::Vector3d& p_camera) {
  Eigen::Vector2d ray = p_camera.head<2>() / p_camera.z();
  if (camera.HasDistortion()) ray = Distort(camera, ray);
  return {camera.fx * ray.x() + camera.cx, camera.fy * ray.y() + camera.cy};
}

}  // namespace posefusion
