#pragma once

#include <Eigen/Geometry>

#include "posefusion/image/depth_noise.h"
#include "posefusion/image/frame_pyramid.h"
#include "posefusion/image/model_view.h"

namespace posefusion {

/// How a frame at a pose agrees with the view predicted there. What the map does not know speaks
/// neither for nor against the pose.
struct Agreement {
  double overlap = 0;      ///< share of the frame's pixels with depth where the view has some, too
  double depth = 0;        ///< of these: share whose depths agree within the noise
  double correlation = 0;  ///< of their intensities (normalised, -1..1), 0 for none
  double intensity = 0;    ///< of those with intensity: share that agrees but for a common offset
};

/// Compares one level of a frame with a view of any resolution.
Agreement CompareWithView(const PyramidLevel& frame, const ModelView& view,
                          const Eigen::Isometry3d& T_view_camera, const DepthNoiseConfig& noise);

}  // namespace posefusion
