#pragma once

#include <cstdint>

namespace posefusion {

/// Everything that updating the surfels of one chunk reads besides them. Plain arrays; images have
/// `width` x `height` pixels.
struct FusionKernelInput {
  const float* depth_m = nullptr;           ///< measured, 0 = none
  const float* nearest_around_m = nullptr;  ///< no surface lies nearer around a pixel, 0 = unknown
  const float* normal_x = nullptr;          ///< camera frame, all 0 = none
  const float* normal_y = nullptr;
  const float* normal_z = nullptr;
  const std::uint8_t* rgb = nullptr;  ///< 3 bytes a pixel
  std::uint8_t* claimed = nullptr;    ///< set to 1 at pixels that measure a surfel
  int width = 0;
  int height = 0;
  float fx = 0, fy = 0, cx = 0, cy = 0;
  float rotation[9] = {};        ///< R_map_camera, row by row
  float translation[3] = {};     ///< camera centre in the map
  float color_rotation[9] = {};  ///< R_color_depth: to the camera of the colour image
  float color_translation[3] = {};
  float min_depth_m = 0;  ///< nearer surfels are not in view

  float association_distance_m = 0, association_sigmas = 0, association_cosine = 0;
  float grazing_cosine = 0;
  float sigma_base = 0, sigma_growth = 0, sigma_offset = 0;
  float max_radius_growth = 0, radius_scale = 0;
  float frame_weight = 0, inverse_falloff = 0;
  float max_confidence = 0, stable_confidence = 0;
  float free_space_distance_m = 0, free_space_sigmas = 0, free_space_weight = 0;
  float color_rate = 0;
  std::int32_t frame = 0;
  std::int32_t first_active_frame = 0;  ///< surfels last seen before it are inactive
  std::int32_t first_fresh_frame = 0;   ///< unstable surfels last seen before it are deleted
};

/// The arrays of one chunk (kChunkCapacity long, the first `size` in use).
struct FusionKernelSurfels {
  float *x, *y, *z, *nx, *ny, *nz, *red, *green, *blue, *radius, *confidence;
  std::uint32_t* last_seen;
  int size;
};

struct FusionKernelCounts {
  int updated = 0;
  int removed = 0;
  int unstable = 0;
};

FusionKernelCounts UpdateSurfels(const FusionKernelInput& input,
                                 const FusionKernelSurfels& surfels);

}  // namespace posefusion
