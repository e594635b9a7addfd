#pragma once

#include "posefusion/config/config.h"
#include "posefusion/image/depth_noise.h"
#include "posefusion/image/frame_pyramid.h"
#include "posefusion/loop_closure/relocalisation_config.h"
#include "posefusion/surfel/fusion_config.h"
#include "posefusion/surfel/splatter.h"
#include "posefusion/surfel/surfel_map.h"
#include "posefusion/tracking/tracking_config.h"

namespace posefusion {

/// Everything that concerns tracking and map, for the Mapping nodelet and run_dataset alike.
struct SlamConfig {
  DepthNoiseConfig depth_noise;
  PyramidConfig pyramid;
  TrackingConfig tracking;
  RelocalisationConfig relocalisation;
  SurfelMapConfig surfel_map;
  FusionConfig fusion;
  SplatConfig splat;
  double slow_motion_m = 0.01;       ///< faster motion than this per frame lowers the weight of ...
  double min_motion_weight = 0.5;    ///< ... its measurements down to this (ElasticFusion)
  double export_min_confidence = 3;  ///< surfels below stay out of map.ply and surfel_cloud
};

template <class V>
void Describe(V& v, SlamConfig& c) {
  v.Group("depth_noise", c.depth_noise);
  v.Group("pyramid", c.pyramid);
  v.Group("tracking", c.tracking);
  v.Group("relocalisation", c.relocalisation);
  v.Group("surfel_map", c.surfel_map);
  v.Group("fusion", c.fusion);
  v.Group("splat", c.splat);
  v.Field("slow_motion_m", c.slow_motion_m, 0.0001, 10.0);
  v.Field("min_motion_weight", c.min_motion_weight, 0.01, 1.0);
  v.Field("export_min_confidence", c.export_min_confidence, 0.0, 1e6);
}

}  // namespace posefusion
