#pragma once

namespace posefusion {

/// Own extension: large planes (floor, wall, table) are found away from the people and followed up
/// to them, and what lies on them is background (the learned data term only takes it for a sign of
/// that). It keeps floors with the feet on them, and people that a network saw in a wall.
struct BackgroundSurfacesConfig {
  bool enabled = true;
  double max_angle_rad = 0.5;             ///< ... and its normal is so close to the plane's
  double min_skeleton_distance_m = 0.18;  ///< a plane is found in cells this far from trunks and
                                          ///< heads, less from limbs ...
  double min_area_m2 = 0.05;              ///< ... and has at least this area there
  double max_near_share = 0.6;            ///< smaller planes have no more than this near seeds
  double min_broken_area_m2 = 0.15;  ///< from this area on, cells count that are cut off from it
  int max_planes = 12;               ///< tried per frame
  double distance_m = 0.015;         ///< a cell on the plane lies this close to it ...
  double distance_sigmas = 1.5;      ///< ... or this many depth noise sigmas
  int num_samples = 80;              ///< planes tried to find the best
};

template <class V>
void Describe(V& v, BackgroundSurfacesConfig& c) {
  v.Field("enabled", c.enabled);
  v.Field("max_angle_rad", c.max_angle_rad, 0.05, 1.6);
  v.Field("min_skeleton_distance_m", c.min_skeleton_distance_m, 0.05, 2.0);
  v.Field("min_area_m2", c.min_area_m2, 0.001, 10.0);
  v.Field("max_near_share", c.max_near_share, 0.0, 1.0);
  v.Field("min_broken_area_m2", c.min_broken_area_m2, 0.001, 100.0);
  v.Field("max_planes", c.max_planes, 1, 20);
  v.Field("distance_m", c.distance_m, 0.001, 0.5);
  v.Field("distance_sigmas", c.distance_sigmas, 0.0, 20.0);
  v.Field("num_samples", c.num_samples, 1, 1000);
}

}  // namespace posefusion
