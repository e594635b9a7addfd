#pragma once

#include <cstdint>

namespace posefusion {

struct SplatProjection {
  int width = 0;
  int height = 0;
  float fx = 0, fy = 0, cx = 0, cy = 0;
  float rotation[9] = {};     ///< R_map_camera, row by row
  float translation[3] = {};  ///< camera centre in the map
  float nearest_m = 0;
  float min_footprint_px = 0;
  std::int32_t first_active_frame = 0;
};

/// Arrays of a chunk, the first `size` in use.
struct SplatSurfels {
  const float *x, *y, *z, *nx, *ny, *nz, *radius;
  const std::uint32_t* last_seen;
  int size;
};

/// Pixel, depth and reach in pixels of every surfel; reach 0 for those that are not to be drawn:
/// free slots, inactive ones, behind the camera, facing away, outside the image.
void ProjectSurfels(const SplatProjection& projection, const SplatSurfels& surfels, float* u,
                    float* v, float* z, float* reach_px);

}  // namespace posefusion
