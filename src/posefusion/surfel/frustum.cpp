#include "posefusion/surfel/frustum.h"

namespace posefusion {

Frustum::Frustum(const CameraModel& camera, const Eigen::Isometry3d& T_map_camera,
                 double max_depth_m, double margin_px) {
  const double left = (-margin_px - camera.cx) / camera.fx;
  const double right = (camera.width - 1 + margin_px - camera.cx) / camera.fx;
  const double top = (-margin_px - camera.cy) / camera.fy;
  const double bottom = (camera.height - 1 + margin_px - camera.cy) / camera.fy;
  const std::array<Eigen::Vector4d, 6> planes_camera = {
      Eigen::Vector4d(1, 0, -left, 0), Eigen::Vector4d(-1, 0, right, 0),
      Eigen::Vector4d(0, 1, -top, 0),  Eigen::Vector4d(0, -1, bottom, 0),
      Eigen::Vector4d(0, 0, 1, 0),     Eigen::Vector4d(0, 0, -1, max_depth_m)};
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const Eigen::Vector3d normal = T_map_camera.linear() * planes_camera[i].head<3>();
    planes_[i].normal = normal.cast<float>();
    planes_[i].offset =
        static_cast<float>(planes_camera[i].w() - normal.dot(T_map_camera.translation()));
  }
}

bool Frustum::Touches(const Box& box) const {
  if (box.empty()) return false;
  for (const Plane& plane : planes_) {
    const Eigen::Vector3f farthest =
        (plane.normal.array() > 0).select(box.max.array(), box.min.array()).matrix();
    if (plane.normal.dot(farthest) + plane.offset < 0) return false;
  }
  return true;
}

}  // namespace posefusion
