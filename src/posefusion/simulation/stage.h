#pragma once

#include "posefusion/simulation/floor_grid.h"
#include "posefusion/simulation/room_plan.h"
#include "posefusion/simulation/traffic.h"
#include "posefusion/simulation/world.h"

namespace posefusion {

/// Distances that people keep from the camera, metres.
constexpr double kToCamera = 0.55;         // nearer to the robot nobody goes
constexpr double kToCrossedCamera = 0.46;  // except to cross before it
constexpr double kToPassedCamera = 0.305;  // or to squeeze past close before it
constexpr double kStepAside = 0.36;        // when there is no other way

constexpr double kTurn_s = 0.8;  ///< to turn before walking off

/// Where people act and who is there already.
struct Stage {
  Stage(const WorldConfig& c, const RoomPlan& p)
      : config(c),
        plan(p),
        grid(p.floor, p.obstacles, 0.27),
        close_grid(p.floor, p.obstacles, 0.16),
        traffic(c) {}

  const WorldConfig& config;
  const RoomPlan& plan;
  FloorGrid grid;        ///< for a walking body
  FloorGrid close_grid;  ///< for one that squeezes past
  Traffic traffic;
};

}  // namespace posefusion
