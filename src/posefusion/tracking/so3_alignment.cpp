#include "posefusion/tracking/so3_alignment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "posefusion/common/lie.h"

namespace posefusion {
namespace {

/// Least scale of the residuals, grey levels.
constexpr double kScaleFloor = 5;
constexpr double kHuber = 1.345;
/// Images that overlap by less than this share of the pixels are not compared.
constexpr double kMinOverlap = 0.3;

struct RotationSystem {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double absolute_sum = 0;
  double sum = 0;
  int rows = 0;

  double Error() const { return rows == 0 ? 1e9 : absolute_sum / rows; }
};

/// Value and gradient of an image between pixels; false where it is not known.
bool Interpolate(const Grid<float>& image, double u, double v, double& value, double& du,
                 double& dv) {
  const int x = static_cast<int>(std::floor(u));
  const int y = static_cast<int>(std::floor(v));
  if (x < 0 || y < 0 || x + 1 >= image.width() || y + 1 >= image.height()) return false;
  const double a = image.at(x, y), b = image.at(x + 1, y);
  const double c = image.at(x, y + 1), d = image.at(x + 1, y + 1);
  if (a < 0 || b < 0 || c < 0 || d < 0) return false;
  const double s = u - x, t = v - y;
  value = (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d);
  du = (1 - t) * (b - a) + t * (d - c);
  dv = (1 - s) * (c - a) + s * (d - b);
  return true;
}

RotationSystem Linearize(const Grid<float>& reference, const Grid<float>& current,
                         const CameraModel& camera, const Eigen::Matrix3d& R, double scale,
                         double brightness) {
  RotationSystem system;
  for (int y = 0; y < current.height(); ++y) {
    for (int x = 0; x < current.width(); ++x) {
      const double intensity = current.at(x, y);
      if (intensity < 0) continue;
      const Eigen::Vector3d q = R * camera.Unproject(x, y, 1);
      if (q.z() < 0.1) continue;
      const Eigen::Vector2d pixel = camera.Project(q);
      double value, du, dv;
      if (!Interpolate(reference, pixel.x(), pixel.y(), value, du, dv)) continue;
      const double r = value + brightness - intensity;
      const double gx = du * camera.fx / q.z();
      const double gy = dv * camera.fy / q.z();
      const Eigen::Vector3d g(gx, gy, -(gx * q.x() + gy * q.y()) / q.z());
      const Eigen::Vector3d jacobian = q.cross(g);
      const double weight = std::abs(r) < kHuber * scale ? 1 : kHuber * scale / std::abs(r);
      system.a += weight * jacobian * jacobian.transpose();
      system.b += weight * r * jacobian;
      system.absolute_sum += std::abs(r);
      system.sum += weight * r;
      ++system.rows;
    }
  }
  return system;
}

}  // namespace

Eigen::Matrix3d AlignRotation(const Grid<float>& reference, const Grid<float>& current,
                              const CameraModel& camera, const So3Config& config) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  const double min_rows = kMinOverlap * camera.width * camera.height;
  double brightness = 0;
  double scale = 50;
  Eigen::Matrix3d best = R;
  double best_error = 1e9;
  for (int i = 0; i < config.max_iterations; ++i) {
    const RotationSystem system = Linearize(reference, current, camera, R, scale, brightness);
    if (system.rows < min_rows) break;
    if (system.Error() < best_error) {
      best_error = system.Error();
      best = R;
    }
    scale = std::max(kScaleFloor, 1.4826 * system.Error());
    brightness -= system.sum / system.rows;
    const Eigen::Vector3d step = -system.a.ldlt().solve(system.b);
    if (!step.allFinite()) break;
    R = ExpSO3(step) * R;
    if (LogSO3(R).norm() > config.max_rotation_rad) break;
    if (step.norm() < config.min_step_rad) break;
  }
  return best;
}

}  // namespace posefusion
