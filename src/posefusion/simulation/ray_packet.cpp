#include "posefusion/simulation/ray_packet.h"

#include <limits>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "posefusion/simulation/renderer.h"

namespace posefusion {

PixelRays::PixelRays(const CameraModel& camera)
    : camera_(camera), rays_(camera.height, camera.width, CV_32FC2) {
  const cv::Matx33d matrix(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  std::vector<cv::Point2d> pixels(static_cast<std::size_t>(camera.width));
  std::vector<cv::Point2d> straight;
  for (int row = 0; row < camera.height; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      pixels[static_cast<std::size_t>(column)] = cv::Point2d(column, row);
    }
    cv::undistortPoints(pixels, straight, matrix, distortion);
    for (int column = 0; column < camera.width; ++column) {
      const cv::Point2d& p = straight[static_cast<std::size_t>(column)];
      rays_.at<cv::Vec2f>(row, column) = {static_cast<float>(p.x), static_cast<float>(p.y)};
    }
  }
}

RayOrigin MakeRayOrigin(const Eigen::Isometry3d& T_map_camera, float time) {
  return {T_map_camera.linear().cast<float>(), T_map_camera.translation().cast<float>(), time,
          static_cast<float>(kNear_m)};
}

void RayPacket::Cast(const RayScene& scene, const PixelRays& rays, int column, int row,
                     const RayOrigin& origin) {
  const CameraModel& camera = rays.camera();
  for (int lane = 0; lane < kRays; ++lane) {
    const int x = column + lane % kSide;
    const int y = row + lane / kSide;
    const bool inside = x < camera.width && y < camera.height;
    valid_[lane] = inside ? -1 : 0;
    if (!inside) continue;
    const Eigen::Vector3f direction =
        origin.R_map_camera * Eigen::Vector3f(rays.x(x, y), rays.y(x, y), 1);
    rays_.ray.org_x[lane] = origin.p_map.x();
    rays_.ray.org_y[lane] = origin.p_map.y();
    rays_.ray.org_z[lane] = origin.p_map.z();
    rays_.ray.dir_x[lane] = direction.x();
    rays_.ray.dir_y[lane] = direction.y();
    rays_.ray.dir_z[lane] = direction.z();
    rays_.ray.tnear[lane] = origin.near_m;
    rays_.ray.tfar[lane] = std::numeric_limits<float>::infinity();
    rays_.ray.time[lane] = origin.time;
    rays_.ray.mask[lane] = 0xffffffffU;
    rays_.ray.flags[lane] = 0;
    rays_.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    rays_.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid_, scene.top(), &context, &rays_);
}

Hit RayPacket::HitOf(int lane) const {
  Hit hit;
  if (!IsInside(lane) || rays_.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.body = static_cast<int>(rays_.hit.instID[0][lane]);
  hit.triangle = static_cast<int>(rays_.hit.primID[lane]);
  hit.depth_m = rays_.ray.tfar[lane];
  hit.u = rays_.hit.u[lane];
  hit.v = rays_.hit.v[lane];
  return hit;
}

}  // namespace posefusion
