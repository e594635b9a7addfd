#pragma once

namespace posefusion {

/// Own extension: large planes around a person (floor, wall, table) are followed up to the person,
/// and what lies on them is background. It keeps floors with the feet on them, and people that a
/// network saw in a wall.
struct BackgroundSurfacesConfig {
  bool enabled = true;
  double min_skeleton_distance_m = 0.35;  ///< a plane is found in cells this far from all seeds ...
  double min_support = 0.04;              ///< ... of which at least this share lies on it
  int max_planes = 4;                     ///< per person
  double distance_m = 0.02;               ///< a cell on the plane lies this close to it ...
  double distance_sigmas = 2.0;           ///< ... or this many depth noise sigmas
  int num_samples = 60;                   ///< planes tried to find the best
};

template <class V>
void Describe(V& v, BackgroundSurfacesConfig& c) {
  v.Field("enabled", c.enabled);
  v.Field("min_skeleton_distance_m", c.min_skeleton_distance_m, 0.05, 2.0);
  v.Field("min_support", c.min_support, 0.001, 1.0);
  v.Field("max_planes", c.max_planes, 1, 20);
  v.Field("distance_m", c.distance_m, 0.001, 0.5);
  v.Field("distance_sigmas", c.distance_sigmas, 0.0, 20.0);
  v.Field("num_samples", c.num_samples, 1, 1000);
}

}  // namespace posefusion
