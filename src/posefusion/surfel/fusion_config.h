#pragma once

#include "posefusion/config/config.h"

namespace posefusion {

/// How measurements become surfels. Numbers of ElasticFusion's shaders where a field says so.
struct FusionConfig {
  double association_distance_m = 0.03;  ///< measurement and surfel are the same surface within
  double association_sigmas = 5.0;       ///< or within so many depth noise sigmas
  double association_angle_rad = 0.7;    ///< between their normals
  double grazing_cosine = 0.1;           ///< flatter views of a surface are not measurements
  double max_radius_growth = 1.5;        ///< coarser measurements only confirm (ElasticFusion)
  double radius_pixels = 1.15;           ///< surfel radius in footprints of half a diagonal
  double weight_falloff = 0.72;          ///< weight exp(-(r / half diagonal)^2 / this)
  double max_confidence = 100.0;         ///< confidence (and so inertia) grows no further

  double unstable_life_s = 0.7;         ///< unstable surfels not seen for so long are deleted
  int recheck_frames = 30;              ///< out of view they are looked for so often
  double time_window_s = 1e6;           ///< surfels not seen for longer are inactive
  double free_space_distance_m = 0.03;  ///< a surfel this far before the measured surface ...
  double free_space_sigmas = 8.0;       ///< ... and so many noise sigmas is contradicted
  double free_space_weight = 5.0;       ///< confidence lost, in measurement weights
  double person_thickness_m = 0.05;  ///< surfels up to so far behind a person's surface are theirs
  int spawn_stride_px = 2;           ///< one pixel of stride x stride may create a surfel
  double color_rate = 1.0;           ///< colour follows with this multiple of the weight
};

template <class V>
void Describe(V& v, FusionConfig& c) {
  v.Field("association_distance_m", c.association_distance_m, 0.001, 0.5);
  v.Field("association_sigmas", c.association_sigmas, 0.0, 50.0);
  v.Field("association_angle_rad", c.association_angle_rad, 0.05, 1.57);
  v.Field("grazing_cosine", c.grazing_cosine, 0.0, 0.9);
  v.Field("max_radius_growth", c.max_radius_growth, 1.0, 10.0);
  v.Field("radius_pixels", c.radius_pixels, 0.5, 4.0);
  v.Field("weight_falloff", c.weight_falloff, 0.05, 100.0);
  v.Field("max_confidence", c.max_confidence, 1.0, 1e6);

  v.Field("unstable_life_s", c.unstable_life_s, 0.0, 1e6);
  v.Field("recheck_frames", c.recheck_frames, 1, 10000);
  v.Field("time_window_s", c.time_window_s, 0.1, 1e9);
  v.Field("free_space_distance_m", c.free_space_distance_m, 0.001, 1.0);
  v.Field("free_space_sigmas", c.free_space_sigmas, 0.0, 100.0);
  v.Field("free_space_weight", c.free_space_weight, 0.0, 1e4);
  v.Field("person_thickness_m", c.person_thickness_m, 0.0, 1.0);
  v.Field("spawn_stride_px", c.spawn_stride_px, 1, 8);
  v.Field("color_rate", c.color_rate, 0.0, 100.0);
}

}  // namespace posefusion
