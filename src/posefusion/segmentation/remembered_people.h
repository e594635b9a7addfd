#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "posefusion/segmentation/carried_people.h"
#include "posefusion/segmentation/cell_grid.h"
#include "posefusion/segmentation/people_velocities.h"

namespace posefusion {

struct RememberedPeopleConfig {
  bool enabled = true;
  double memory_s = 3.0;  ///< whoever is out of view stays where they were for so long
  double max_difference_m =
      0.08;                   ///< a cell this close in depth to where somebody was is theirs ...
  double speed_m_s = 0.1;     ///< ... and so much more for each second since
  double min_walk_m_s = 0.3;  ///< whoever was faster goes on walking there
};

template <class V>
void Describe(V& v, RememberedPeopleConfig& c) {
  v.Field("enabled", c.enabled);
  v.Field("memory_s", c.memory_s, 0.0, 60.0);
  v.Field("max_difference_m", c.max_difference_m, 0.0, 1.0);
  v.Field("speed_m_s", c.speed_m_s, 0.0, 10.0);
  v.Field("min_walk_m_s", c.min_walk_m_s, 0.0, 100.0);
}

/// A place of somebody who is out of the view or hidden.
struct RememberedPlace {
  Eigen::Vector3f p_camera;  ///< metres, in the camera frame of the frame that it belongs to
  CellPerson person = kNobody;
  float evidence = 0;
  double seen_s = 0;  ///< time of the last frame that showed it
};

using RememberedPeople = std::vector<RememberedPlace>;

/// What is known of people in a frame.
struct PeopleThen {
  const CellPeople& people;
  const CellGrid& cells;
  const RememberedPeople& remembered;
  double time_s;
  const PeopleVelocities& velocities;  ///< in the camera frame of that frame
};

/// Takes everybody of the frame before into now by the camera's motion, as if they stood still or
/// went on walking as before. Cells of `people` that are unknown and show a surface where somebody
/// was become theirs; what is out of the view or hidden is remembered. `people` holds what
/// CarryPeople found.
void RememberPeople(const PeopleThen& before, const Eigen::Isometry3f& T_before_now,
                    const CellGrid& cells, double time_s, const RememberedPeopleConfig& config,
                    CellPeople& people, RememberedPeople& remembered);

}  // namespace posefusion
