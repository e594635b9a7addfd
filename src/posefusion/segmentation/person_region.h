#pragma once

#include <opencv2/core/types.hpp>
#include <optional>

#include "posefusion/segmentation/cell_grid.h"
#include "posefusion/segmentation/seeds.h"

namespace posefusion {

struct PersonRegionConfig {
  double margin_m = 0.4;        ///< the region reaches so far beyond the joints
  double missing_part_m = 0.5;  ///< and so much further where head, knees or ankles are missing
  double depth_before_m = 0.9;  ///< from the nearest seed towards the camera
  double depth_behind_m = 0.5;  ///< from the farthest seed away from the camera
};

template <class V>
void Describe(V& v, PersonRegionConfig& c) {
  v.Field("margin_m", c.margin_m, 0.05, 3.0);
  v.Field("missing_part_m", c.missing_part_m, 0.0, 3.0);
  v.Field("depth_before_m", c.depth_before_m, 0.0, 5.0);
  v.Field("depth_behind_m", c.depth_behind_m, 0.0, 5.0);
}

/// Part of the image and range of depth that a person can fill.
struct PersonRegion {
  cv::Rect cells;  ///< in cells; empty when there is nothing to cut
  float min_depth_m = 0;
  float max_depth_m = 0;
};

/// Around the seeds of a person; empty without seeds. `gravity`: unit vector downwards in the
/// camera frame, which tells where missing parts are; down the image without it.
PersonRegion RegionOf(const PersonSeeds& person, const CellGrid& cells, const CameraModel& camera,
                      const PersonRegionConfig& config,
                      const std::optional<Eigen::Vector3f>& gravity = std::nullopt);

}  // namespace posefusion
