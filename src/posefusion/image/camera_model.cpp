#include "posefusion/image/camera_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace posefusion {

bool CameraModel::HasDistortion() const {
  return std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0; });
}

CameraModel CameraModel::Undistorted() const {
  CameraModel camera = *this;
  camera.distortion.fill(0);
  return camera;
}

CameraModel CameraModel::AtLevel(int level) const {
  CameraModel camera = *this;
  for (int i = 0; i < level; ++i) {
    camera.width /= 2;
    camera.height /= 2;
    camera.fx /= 2;
    camera.fy /= 2;
    camera.cx = (camera.cx - 0.5) / 2;
    camera.cy = (camera.cy - 0.5) / 2;
  }
  return camera;
}

int CameraModel::UsefulLevels(int wanted) const {
  constexpr int kLeastSize = 8;
  int levels = 1;
  while (levels < wanted && (std::min(width, height) >> levels) >= kLeastSize) ++levels;
  return levels;
}

Eigen::Vector2d CameraModel::Project(const Eigen::Vector3d& p_camera) const {
  return {fx * p_camera.x() / p_camera.z() + cx, fy * p_camera.y() / p_camera.z() + cy};
}

Eigen::Vector3d CameraModel::Unproject(double u, double v, double z) const {
  return {(u - cx) / fx * z, (v - cy) / fy * z, z};
}

void CameraModel::Check(const std::string& source) const {
  if (width < 1 || height < 1) {
    throw std::invalid_argument(source + ": image size " + std::to_string(width) + " x " +
                                std::to_string(height) + " is not positive");
  }
  const bool finite =
      std::isfinite(fx) && std::isfinite(fy) && std::isfinite(cx) && std::isfinite(cy) &&
      std::all_of(distortion.begin(), distortion.end(), [](double k) { return std::isfinite(k); });
  if (!finite || fx <= 0 || fy <= 0) {
    throw std::invalid_argument(source + ": intrinsics fx " + std::to_string(fx) + " fy " +
                                std::to_string(fy) + " cx " + std::to_string(cx) + " cy " +
                                std::to_string(cy) + " make no camera");
  }
}

bool operator==(const CameraModel& a, const CameraModel& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy && a.distortion == b.distortion;
}

}  // namespace posefusion
