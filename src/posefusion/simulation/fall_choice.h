#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "posefusion/simulation/fall.h"
#include "posefusion/simulation/robot_model.h"

namespace posefusion {

/// Distance of a point on the floor from the nearest box, metres.
double FloorClearance(const Eigen::Vector2d& p, const std::vector<Eigen::AlignedBox2d>& boxes);

/// Where a robot stands that is to fall.
struct FallSite {
  Eigen::Vector2d position;
  double heading_rad;
  NeckAngles neck;  ///< about how it holds its head
  const std::vector<Eigen::AlignedBox2d>& obstacles;
};

/// How it falls: it may turn before.
struct FallChoice {
  double heading_rad;
  Eigen::Vector2d direction;  ///< as Fall's
};

/// A fall after which the camera sees what `fall.view` wants, where the floor is free for the
/// lying robot and, for a passer-by, before its camera; with as little turning as possible. When
/// there is none: the fall without a turn that has most room. `dice(low, high)` gives random
/// numbers.
FallChoice ChooseFall(const Fall& fall, const FallSite& site,
                      const std::function<double(double, double)>& dice);

}  // namespace posefusion
