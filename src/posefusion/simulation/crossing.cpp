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
  double pause_s;  ///< in the middle, turning to the camera
  double step_s;   ///< between meetings
};

Choices ChoicesOf(CrossingKind kind) {
  if (kind == CrossingKind::kNear) {
    return {{0.52, 0.65, 0.8, 1.0}, {0.9, -0.9, 0.65, -0.65}, kToCrossedCamera, 0, 0.5};
  }
  return {{0.33, 0.37, 0.41}, {0.9, -0.9, 0.65, -0.65, 0.45, -0.45}, kToPassedCamera, 1.2, 0.25};
}

struct Crossing {
  std::vector<Vector2d> approach;  ///< to where the picture begins
  std::vector<Vector2d> way;       ///< through its middle
  Vector2d camera;
  double approach_from_s;
  double from_s;
  double meet_s;  ///< in the middle
  double pause_s;
};

/// Whether the way through the picture is free, and its end for some time.
bool IsFree(const Crossing& c, double half_s, double to_camera, const Stage& stage) {
  const Traffic& traffic = stage.traffic;
  const double go_on_s = c.meet_s + c.pause_s;
  if (!stage.close_grid.IsFree(c.way.front(), c.way.back())) return false;
  if (traffic.IsTaken(std::vector<Vector2d>{c.way[0], c.way[1]}, c.from_s, half_s, to_camera))
    return false;
  if (traffic.IsTaken(c.way[1], c.meet_s, go_on_s, to_camera)) return false;
  if (traffic.IsTaken(std::vector<Vector2d>{c.way[1], c.way[2]}, go_on_s, half_s, to_camera))
    return false;
  for (double t = go_on_s + half_s; t < go_on_s + half_s + kRest_s; t += 1) {
    if (traffic.IsTaken(c.way[2], t, t + 1, to_camera)) return false;
  }
  return true;
}

/// The crossing that meets the middle of the picture at meet_s, when it can be walked.
std::optional<Crossing> CrossingAt(double meet_s, double distance, double half,
                                   const Choices& choices, double speed, const Stage& stage,
                                   const Script& script) {
  const Eigen::Isometry3d T = stage.config.head->T_map_camera(meet_s);
  if (T.translation().z() < kLowestCamera) return std::nullopt;
  const Vector2d camera = T.translation().head<2>();
  const Vector2d forward = T.linear().col(2).head<2>().normalized();
  const Vector2d middle = camera + distance * forward;
  const Vector2d side(-forward.y() * half, forward.x() * half);
  Crossing c{{}, {middle + side, middle, middle - side}, camera, 0, 0, meet_s, choices.pause_s};
  const double half_s = WalkingTime({c.way[0], c.way[1]}, speed);
  c.from_s = meet_s - half_s;
  if (!IsFree(c, half_s, choices.to_camera, stage)) return std::nullopt;
  c.approach = stage.grid.Way(script.here(), c.way.front());
  if (c.approach.size() < 2) return std::nullopt;
  const double approach_s = WalkingTime(c.approach, speed);
  c.approach_from_s = c.from_s - kTurn_s - approach_s;
  const Traffic& traffic = stage.traffic;
  if (c.approach_from_s < script.now_s() + 0.3 ||
      traffic.IsTaken(script.here(), script.now_s(), c.approach_from_s, choices.to_camera) ||
      traffic.IsTaken(c.approach, c.approach_from_s, approach_s, choices.to_camera)) {
    return std::nullopt;
  }
  return c;
}

void Follow(const Crossing& c, double speed, Script& script) {
  script.WalkAt(c.approach_from_s, c.approach, WalkingTime(c.approach, speed));
  script.StandAt(c.way[0], YawOf(c.way[2] - c.way[0]), c.from_s - script.now_s(), Gesture::kNone);
  if (c.pause_s == 0) return script.Walk(c.way, 2 * (c.meet_s - c.from_s));
  script.Walk({c.way[0], c.way[1]}, c.meet_s - c.from_s);
  script.StandAt(c.way[1], YawOf(c.camera - c.way[1]), c.pause_s, Gesture::kNone);
  script.Walk({c.way[1], c.way[2]}, c.meet_s - c.from_s);
}

}  // namespace

bool Cross(CrossingKind kind, const Stage& stage, double speed, Script& script) {
  if (!stage.config.head) return false;
  const Choices choices = ChoicesOf(kind);
  for (double delay = kFirst_s; delay < kLast_s; delay += choices.step_s) {
    for (const double distance : choices.distances) {
      for (const double half : choices.halves) {
        const double meet_s = script.now_s() + delay;
        const auto crossing = CrossingAt(meet_s, distance, half, choices, speed, stage, script);
        if (!crossing) continue;
        Follow(*crossing, speed, script);
        return true;
      }
    }
  }
  return false;
}

}  // namespace posefusion
