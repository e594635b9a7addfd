#include "posefusion/simulation/fall_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace posefusion {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr int kDirections = 16;
constexpr std::array<double, 9> kTurnsRad = {0, 0.4, -0.4, 0.8, -0.8, 1.2, -1.2, 1.6, -1.6};
constexpr double kHeadReachM = 1.6;  ///< where the head of a fallen robot is
constexpr double kClearanceM = 0.25;
constexpr double kPersonClearanceM = 0.3;
constexpr double kMinFloorSlope = -0.6;  ///< z of a line of sight that ends on the floor near by
constexpr double kMaxLevelSlope = 0.3;   ///< of a level one, to either side
constexpr double kNearestPersonM = 1.2;
constexpr double kFarthestPersonM = 1.8;

/// Least clearance of the straight way from `p + from_m * direction` to `p + to_m * direction`.
double ClearanceAlong(const Eigen::Vector2d& p, const Eigen::Vector2d& direction, double from_m,
                      double to_m, const std::vector<Eigen::AlignedBox2d>& boxes) {
  constexpr int kPoints = 8;
  double clearance = std::numeric_limits<double>::infinity();
  for (int i = 1; i <= kPoints; ++i) {
    const double distance = from_m + (to_m - from_m) * i / kPoints;
    clearance = std::min(clearance, FloorClearance(p + direction * distance, boxes));
  }
  return clearance;
}

/// Pose of the camera in the map while the robot lies.
Eigen::Isometry3d T_map_lying(const Fall& fall, const FallSite& site, double heading_rad) {
  Eigen::Isometry3d T(Eigen::Translation3d(site.position.x(), site.position.y(), 0));
  T.rotate(Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()));
  return T * fall.T_footprint_tipped(fall.raise_s()) * Eigen::Translation3d(0, 0, kBodyHeightM) *
         T_body_camera(site.neck);
}

bool Shows(FallView view, const Eigen::Isometry3d& T_map_camera, const FallSite& site) {
  const Eigen::Vector3d sight = T_map_camera.linear().col(2);
  if (view == FallView::kFloor) return sight.z() < kMinFloorSlope;
  if (std::abs(sight.z()) > kMaxLevelSlope) return false;
  if (view == FallView::kWall) return true;
  return ClearanceAlong(T_map_camera.translation().head<2>(), sight.head<2>().normalized(),
                        kNearestPersonM, kFarthestPersonM, site.obstacles) >= kPersonClearanceM;
}

}  // namespace

double FloorClearance(const Eigen::Vector2d& p, const std::vector<Eigen::AlignedBox2d>& boxes) {
  double clearance = std::numeric_limits<double>::infinity();
  for (const auto& box : boxes) clearance = std::min(clearance, box.exteriorDistance(p));
  return clearance;
}

FallChoice ChooseFall(const Fall& fall, const FallSite& site,
                      const std::function<double(double, double)>& dice) {
  const int first = static_cast<int>(dice(0, kDirections));
  const double side = dice(0, 1) < 0.5 ? -1 : 1;
  FallChoice most_room{site.heading_rad, Eigen::Vector2d::UnitX()};
  double most_clearance = -1;
  for (const double turn : kTurnsRad) {
    const double heading = site.heading_rad + side * turn;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * kPi * ((first + i) % kDirections) / kDirections;
      Fall trial = fall;
      trial.direction = Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const Eigen::Vector2d way = Eigen::Rotation2Dd(heading) * trial.direction;
      const double clearance = ClearanceAlong(site.position, way, 0, kHeadReachM, site.obstacles);
      if (turn == 0 && clearance > most_clearance) {
        most_clearance = clearance;
        most_room.direction = trial.direction;
      }
      if (clearance < kClearanceM) continue;
      if (Shows(fall.view, T_map_lying(trial, site, heading), site)) {
        return {heading, trial.direction};
      }
    }
  }
  return most_room;
}

}  // namespace posefusion
