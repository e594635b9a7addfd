#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "posefusion/common/parallel.h"
#include "posefusion/image/camera_model.h"
#include "posefusion/image/grid.h"

namespace posefusion {

/// One pixel of the predicted geometry: the plane through the surface, in the view's camera frame.
struct ModelPlane {
  float nx = 0, ny = 0, nz = 0;  ///< unit normal towards the camera
  float offset_m = 0;            ///< normal . point, for every point of the plane
};

/// One pixel of the predicted intensity image.
struct ModelIntensity {
  float value = -1;      ///< grey 0..255, below 0 = none
  float gradient_x = 0;  ///< per pixel of its own level
  float gradient_y = 0;
  float padding = 0;
};

/// One resolution of the predicted intensity.
struct IntensityLevel {
  CameraModel camera;
  Grid<ModelIntensity> pixels;
};

/// The static room as the map predicts it from one pose: what a frame is aligned to.
struct ModelView {
  CameraModel camera;  ///< of the geometry
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  Grid<float> depth_m;      ///< along the optical axis, 0 = nothing there
  Grid<ModelPlane> planes;  ///< where depth_m > 0
  Grid<float> intensity;    ///< grey 0..255 where depth_m > 0, below 0 elsewhere
  Grid<float> confidence;   ///< of the surfels behind the pixel, 0 = nothing there
  std::vector<Grid<float>> halved_intensity;     ///< working memory of BuildIntensityLevels
  std::vector<IntensityLevel> intensity_levels;  ///< 0 = resolution of the geometry
};

/// Makes the intensity levels, as many as are useful, with gradients (central differences; none
/// beside missing pixels).
void BuildIntensityLevels(int num_levels, const ParallelRunner& parallel, ModelView& view);

}  // namespace posefusion
