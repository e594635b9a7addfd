#pragma once

#include <opencv2/core/mat.hpp>

#include "posefusion/common/parallel.h"
#include "posefusion/simulation/renderer.h"
#include "posefusion/simulation/sensor_config.h"

namespace posefusion {

/// Standard deviation in metres of a depth of z metres on a surface whose normal is angle_rad from
/// the ray. Nguyen, Izadi, Lovell, "Modeling Kinect Sensor Noise for Improved 3D Reconstruction
/// and Tracking", 3DIMPVT 2012, eq. 2 and its limit for small angles.
float AxialNoise(const DepthSensorConfig& config, float z_m, float angle_rad);

/// Standard deviation in pixels of the place of an edge. Nguyen et al. 2012, eq. 1.
float LateralNoise(const DepthSensorConfig& config, float angle_rad);

/// The nearest depth that the sensor can tell: disparities are whole multiples of a step.
/// Khoshelham, Elberink, "Accuracy and Resolution of Kinect Depth Data for Indoor Mapping
/// Applications", Sensors 12(2), 2012, eq. 10: steps grow as z^2, 2.8 mm at 1 m, 7 cm at 5 m.
float QuantizedDepth(const DepthSensorConfig& config, float z_m);

/// Where the pattern of the projector, `baseline_m` to the right of the camera, does not reach
/// because something nearer stands in its way. CV_8UC1, 255 = shadow.
cv::Mat ProjectorShadow(const DepthSensorConfig& config, const CameraModel& camera,
                        const cv::Mat& depth_m, const ParallelRunner& runner);

/// What the sensor makes of a noise-free view: CV_32FC1 whole millimetres in metres, 0 = none.
/// Edges waver, depths are noisy and quantised; nothing comes back from shadows, out of range, from
/// grazing and from dark surfaces (the light that returns falls with reflectance * cosine / z^2).
cv::Mat DepthImage(const DepthSensorConfig& config, const CameraModel& camera, const View& view,
                   std::uint32_t key, const ParallelRunner& runner);

}  // namespace posefusion
