#include "posefusion/simulation/crossing.h"

#include <cmath>
#include <optional>

namespace posefusion {
namespace {

using Eigen::Vector2d;

constexpr double kFirst_s = 3;  ///< from now to the meeting
constexpr double kLast_s = 11;
constexpr double kRest_s = 4;          ///< so long nobody comes to where the crossing ends
constexpr double kLowestCamera = 1.0;  ///< nobody steps over a camera on the floor

/// What may be tried, best first; metres.
struct Choices {
  std::vector<double> distances;  ///< from the camera
  std::vector<double> halves;     ///< of the way through the picture, with sign
  double to_camera;
  double step_s;
};

Choices ChoicesOf(CrossingKind kind) {
  if (kind == CrossingKind::kNear) {
    return {{0.52, 0.65, 0.8, 1.0}, {0.9, -0.9, 0.65, -0.65}, kToCrossedCamera, 0.5};
  }
  return {{0.33, 0.37, 0.41}, {0.9, -0.9, 0.65, -0.65, 0.45, -0.45}, kToPassedCamera, 0.25};
}

struct Crossing {
  std::vector<Vector2d> way;       ///< through the picture
  std::vector<Vector2d> approach;  ///< to its start
  double approach_from_s;
  double approach_s;
  double from_s;
  double duration_s;
};

/// The crossing that meets the middle of the picture at meet_s, when it can be walked.
std::optional<Crossing> CrossingAt(double meet_s, double distance, double half, double to_camera,
                                   double speed, const Stage& stage, const Script& script) {
  const Eigen::Isometry3d T = stage.config.head->T_map_camera(meet_s);
  if (T.translation().z() < kLowestCamera) return std::nullopt;
  const Vector2d forward = T.linear().col(2).head<2>().normalized();
  const Vector2d middle = T.translation().head<2>() + distance * forward;
  const Vector2d side(-forward.y() * half, forward.x() * half);
  Crossing c{{middle + side, middle - side}, {}, 0, 0, 0, 0};
  if (!stage.close_grid.IsFree(c.way.front(), c.way.back())) return std::nullopt;
  c.duration_s = WalkingTime(c.way, speed);
  c.from_s = meet_s - c.duration_s / 2;
  const Traffic& traffic = stage.traffic;
  if (traffic.IsTaken(c.way, c.from_s, c.duration_s, to_camera)) return std::nullopt;
  const double end_s = c.from_s + c.duration_s;
  for (double t = end_s; t < end_s + kRest_s; t += 1) {
    if (traffic.IsTaken(c.way.back(), t, t + 1, to_camera)) return std::nullopt;
  }
  c.approach = stage.grid.Way(script.here(), c.way.front());
  if (c.approach.size() < 2) return std::nullopt;
  c.approach_s = WalkingTime(c.approach, speed);
  c.approach_from_s = c.from_s - kTurn_s - c.approach_s;
  if (c.approach_from_s < script.now_s() + 0.3 ||
      traffic.IsTaken(script.here(), script.now_s(), c.approach_from_s, to_camera) ||
      traffic.IsTaken(c.approach, c.approach_from_s, c.approach_s, to_camera)) {
    return std::nullopt;
  }
  return c;
}

void Follow(const Crossing& c, Script& script) {
  script.WalkAt(c.approach_from_s, c.approach, c.approach_s);
  script.StandAt(c.way.front(), YawOf(c.way.back() - c.way.front()), c.from_s - script.now_s(),
                 Gesture::kNone);
  script.Walk(c.way, c.duration_s);
}

}  // namespace

bool Cross(CrossingKind kind, const Stage& stage, double speed, Script& script) {
  if (!stage.config.head) return false;
  const Choices choices = ChoicesOf(kind);
  for (double delay = kFirst_s; delay < kLast_s; delay += choices.step_s) {
    for (const double distance : choices.distances) {
      for (const double half : choices.halves) {
        const auto crossing = CrossingAt(script.now_s() + delay, distance, half, choices.to_camera,
                                         speed, stage, script);
        if (!crossing) continue;
        Follow(*crossing, script);
        return true;
      }
    }
  }
  return false;
}

}  // namespace posefusion
