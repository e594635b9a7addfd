#pragma once

#include "posefusion/config/config.h"

namespace posefusion {

/// Everything of the Mapping nodelet and of run_dataset that concerns tracking and map.
struct SlamConfig {
  double export_min_confidence = 0;  ///< surfels below stay out of map.ply and surfel_cloud
};

template <class V>
void Describe(V& v, SlamConfig& c) {
  v.Field("export_min_confidence", c.export_min_confidence, 0.0, 1e6);
}

}  // namespace posefusion
