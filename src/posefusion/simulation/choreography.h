#pragma once

#include <vector>

#include "posefusion/simulation/person_timeline.h"
#include "posefusion/simulation/room_plan.h"
#include "posefusion/simulation/world.h"

namespace posefusion {

/// What everybody does during a run, and what happens to things meanwhile.
struct Choreography {
  std::vector<PersonTimeline> people;
  std::vector<BodyShape> shapes;
  struct Move {
    bool happens = false;
    double from_s = 0;
    double to_s = 0;
  };
  std::vector<Move> moves;  ///< one per object of the plan
};

/// Person 0 walks about, pushes the chair and crosses in front of the camera; person 1 sits
/// motionless for half a minute or longer, then gets up; the others walk, talk, leave and return.
/// Of two or more, one passes close before the camera every minute. Somebody comes to each of
/// config.visits when there is a way in time.
Choreography MakeChoreography(const WorldConfig& config, const RoomPlan& plan);

}  // namespace posefusion
