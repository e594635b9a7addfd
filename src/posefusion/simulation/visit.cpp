#include "posefusion/simulation/visit.h"

#include <algorithm>

#include "posefusion/simulation/person_view.h"

namespace posefusion {
namespace {

using Eigen::Vector2d;

constexpr double kShortestStay_s = 0.8;
constexpr double kLongestStay_s = 2.5;
constexpr double kEarliest_s = 1.0;     ///< before the visit begins
constexpr double kMinCoverage = 0.03;   ///< share of the picture that shows the person
constexpr double kToLyingCamera = 0.8;  ///< metres

/// Whether somebody, or the camera on its true way, comes to the place.
bool IsPassed(const Traffic& traffic, const Vector2d& place, double from_s, double to_s,
              double to_camera) {
  constexpr double kPiece_s = 1;
  for (double t = from_s; t <= to_s; t += kPiece_s) {
    if (traffic.IsTaken(place, t, std::min(t + kPiece_s, to_s), to_camera)) return true;
  }
  return false;
}

/// Free places that can be seen, best first.
std::vector<Vector2d> PlacesInView(const Eigen::Isometry3d& T_map_camera, const Stage& stage) {
  const Vector2d eye = T_map_camera.translation().head<2>();
  const Vector2d forward = T_map_camera.linear().col(2).head<2>().normalized();
  std::vector<Vector2d> places;
  for (const double distance : {1.5, 1.25, 1.8, 2.1, 2.4, 1.05}) {
    for (const double aside : {0.0, 0.25, -0.25, 0.5, -0.5, 0.8, -0.8}) {
      const Vector2d place = eye + distance * forward + aside * Vector2d(-forward.y(), forward.x());
      if (!stage.grid.IsFree(place)) continue;
      Posture posture;
      posture.floor = place;
      posture.yaw = YawOf(eye - place);
      if (CoveredShare(PoseBody(BodyShape(), posture), T_map_camera) < kMinCoverage) continue;
      places.push_back(place);
    }
  }
  return places;
}

}  // namespace

bool VisitCamera(const CameraVisit& visit, const Stage& stage, double speed, Script& script) {
  const Eigen::Isometry3d T = stage.config.head->T_map_camera((visit.from_s + visit.to_s) / 2);
  const Traffic& traffic = stage.traffic;
  for (const Vector2d& place : PlacesInView(T, stage)) {
    const std::vector<Vector2d> way = stage.grid.Way(script.here(), place);
    if (way.size() < 2) continue;
    const double walk_s = WalkingTime(way, speed);
    const double first_s = std::max(script.now_s() + kTurn_s + walk_s, visit.from_s - kEarliest_s);
    for (double arrive_s = first_s; arrive_s < visit.to_s - kShortestStay_s; arrive_s += 0.4) {
      const double depart_s = arrive_s - walk_s;
      const double leave_s = std::min(visit.to_s, arrive_s + kLongestStay_s);
      if (IsPassed(traffic, script.here(), script.now_s(), depart_s, kStepAside) ||
          traffic.IsTaken(way, depart_s, walk_s, kStepAside) ||
          IsPassed(traffic, place, arrive_s, leave_s, kToLyingCamera)) {
        continue;
      }
      script.WalkAt(depart_s, way, walk_s);
      script.StandAt(place, YawOf(T.translation().head<2>() - place), leave_s - arrive_s,
                     Gesture::kNone);
      return true;
    }
  }
  return false;
}

}  // namespace posefusion
