#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "posefusion/segmentation/cell_grid.h"
#include "posefusion/skeleton/skeletons.h"

namespace posefusion {

/// Somebody nearer than the sensor measures leaves a hole in the depth image.
struct NearPeopleConfig {
  bool enabled = true;
  double min_joint_confidence = 0.5;  ///< a joint this certain in a hole makes it a person
  int min_cells = 200;                ///< smaller holes are no one too near
  double max_depth_m = 0.9;           ///< what is measured around the hole and nearer belongs to it
  int margin_cells = 6;               ///< ... this far from it
  double hold_s = 1.0;                ///< so long without joints while the hole stays where it is
};

template <class V>
void Describe(V& v, NearPeopleConfig& c) {
  v.Field("enabled", c.enabled);
  v.Field("min_joint_confidence", c.min_joint_confidence, 0.0, 1.0);
  v.Field("min_cells", c.min_cells, 1, 1000000);
  v.Field("max_depth_m", c.max_depth_m, 0.0, 5.0);
  v.Field("margin_cells", c.margin_cells, 0, 100);
  v.Field("hold_s", c.hold_s, 0.0, 100.0);
}

/// Where people are who are too near to be measured.
struct NearPeople {
  cv::Mat cells;                 ///< CV_8UC1 of the cells' size, 255 = person; empty = nobody
  std::optional<double> seen_s;  ///< when joints said so last, seconds since any origin
};

/// Holes in the depth that a certain joint of `skeletons` lies in (null: none are known of this
/// frame), or that most of the people of the frame before fill, with their near rims. `time_s` is
/// of this frame, on the same origin as `before`.
NearPeople FindNearPeople(const CellGrid& cells, const Skeletons* skeletons,
                          const NearPeople& before, double time_s, const NearPeopleConfig& config);

}  // namespace posefusion
