#include "posefusion/simulation/person_view.h"

#include <algorithm>

namespace posefusion {
namespace {

constexpr int kColumns = 32;
constexpr int kRows = 24;
constexpr double kHalfWidth = 320.0 / 525;  ///< of the picture in a distance of 1
constexpr double kHalfHeight = 240.0 / 525;

/// Whether a ray comes within the radius of the capsule's line (closest points of two lines:
/// Ericson, "Real-Time Collision Detection", 5.1.9).
bool Meets(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
           const Capsule& capsule) {
  const Eigen::Vector3d axis = capsule.to - capsule.from;
  const Eigen::Vector3d offset = origin - capsule.from;
  const double square = axis.squaredNorm();
  const double along = direction.dot(axis);
  const double denominator = square - along * along;
  double part = 0;
  if (denominator > 1e-9) {
    part = (axis.dot(offset) - along * direction.dot(offset)) / denominator;
  }
  part = std::clamp(part, 0.0, 1.0);
  const double reach = std::max(0.0, direction.dot(part * axis - offset));
  const Eigen::Vector3d point = origin + reach * direction;
  if (square > 0) part = std::clamp(axis.dot(point - capsule.from) / square, 0.0, 1.0);
  return reach > 0 && (point - capsule.from - part * axis).norm() < capsule.radius_m;
}

}  // namespace

double CoveredShare(const PersonPose& person, const Eigen::Isometry3d& T_map_camera) {
  if (!person.present) return 0;
  const Eigen::Vector3d origin = T_map_camera.translation();
  int num_covered = 0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Eigen::Vector3d p_camera(kHalfWidth * ((2 * column + 1.0) / kColumns - 1),
                                     kHalfHeight * ((2 * row + 1.0) / kRows - 1), 1);
      const Eigen::Vector3d direction = (T_map_camera.linear() * p_camera).normalized();
      const auto meets = [&](const Capsule& c) { return Meets(origin, direction, c); };
      if (std::any_of(person.capsules.begin(), person.capsules.end(), meets)) ++num_covered;
    }
  }
  return static_cast<double>(num_covered) / (kColumns * kRows);
}

}  // namespace posefusion
