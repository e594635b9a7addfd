#pragma once

#include <vector>

#include "posefusion/simulation/fall.h"
#include "posefusion/simulation/route.h"
#include "posefusion/simulation/uniform_spline.h"

namespace posefusion {

struct WalkPlanConfig {
  int seed = 1;
  double seconds = 60;
  double first_fall_s = 0;    ///< about when it falls first; 0 = never
  double fall_period_s = 15;  ///< from one fall to the next, about
  double acceleration_m_s2 = 0.3;
};

/// What the robot does on the floor, second by second.
struct WalkPlan {
  /// x, y (map, metres) and heading (radians, continuous, not wrapped) of the footprint, and how
  /// strongly it steps: 0 stands, 1 walks.
  using Track = UniformSpline<4>;

  Track track;
  std::vector<Fall> falls;  ///< in order of time
};

/// Plans a walk along a route with stops, turns in place and falls; falls go where the floor is
/// free of `obstacles`. The robot stands still at both ends.
WalkPlan PlanWalk(const Route& route, const std::vector<Eigen::AlignedBox2d>& obstacles,
                  const WalkPlanConfig& config);

}  // namespace posefusion
