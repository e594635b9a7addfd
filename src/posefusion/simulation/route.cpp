#include "posefusion/simulation/route.h"

#include <algorithm>
#include <cmath>

#include "posefusion/simulation/indexed_random.h"

namespace posefusion {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr int kRouteStream = 301;
constexpr int kEllipsePoints = 72;

// Free ways of RoomKind::kLab, see there.
const Eigen::Vector2d kEllipse(1.55, 1.25);
const Eigen::Vector2d kRectangle(2.1, 1.6);

/// 1 for anticlockwise, -1 for clockwise.
double SenseOf(const IndexedRandom& random) { return random.Uniform(0) < 0.5 ? 1 : -1; }

}  // namespace

Route TableRoute(int seed) {
  const IndexedRandom random(seed, kRouteStream);
  const double sense = SenseOf(random);
  const double start = kTwoPi * random.Uniform(1);
  Route route;
  for (int i = 0; i < kEllipsePoints; ++i) {
    const double angle = start + sense * kTwoPi * i / kEllipsePoints;
    route.points.emplace_back(kEllipse.x() * std::cos(angle), kEllipse.y() * std::sin(angle));
  }
  route.closed = true;
  route.look_aside_rad = 0.5 * sense;
  route.gaze_yaw_rad = 1.1 * sense;
  route.gaze_range_rad = 0.3;
  route.gaze_pitch_rad = 0.35;
  return route;
}

Route WallRoute(int seed) {
  const IndexedRandom random(seed, kRouteStream);
  const double sense = SenseOf(random);
  Route route;
  route.points = {kRectangle,
                  {-kRectangle.x(), kRectangle.y()},
                  -kRectangle,
                  {kRectangle.x(), -kRectangle.y()}};
  if (sense < 0) std::reverse(route.points.begin(), route.points.end());
  const auto first = static_cast<long>(4 * random.Uniform(1));
  std::rotate(route.points.begin(), route.points.begin() + first, route.points.end());
  route.closed = true;
  route.look_aside_rad = -0.5 * sense;
  route.gaze_yaw_rad = -0.35 * sense;
  route.gaze_pitch_rad = 0.2;
  return route;
}

Route LongRoute() {
  Route route;
  route.points = CorridorRoute();
  route.speed_m_s = 0.4;
  route.turn_rad_s = 0.45;
  route.leg_m = 15;
  route.gaze_range_rad = 0.35;
  route.gaze_pitch_rad = 0.2;
  return route;
}

}  // namespace posefusion
