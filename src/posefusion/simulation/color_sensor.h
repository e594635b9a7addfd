#pragma once

#include <opencv2/core/mat.hpp>

#include "posefusion/common/parallel.h"
#include "posefusion/simulation/sensor_config.h"

namespace posefusion {

/// Automatic gain at a time: 1 on average, drifting slowly by at most `gain_drift`.
double GainAt(const ColorSensorConfig& config, int seed, double time_s);

/// Share of light that reaches a pixel: 1 in the middle, 1 - vignetting in the corners.
float LightLoss(const ColorSensorConfig& config, const CameraModel& camera, int column, int row);

/// Standard deviation of a pixel's linear value in [0, 1] (EMVA Standard 1288, release 3.1, eq. 12:
/// photon noise and dark noise add in squares), before quantisation to 255 * sqrt(value).
float ColorNoise(const ColorSensorConfig& config, float value);

/// Linear radiance (CV_32FC3) to the image of the sensor (CV_8UC3): lens blur, vignetting, gain,
/// noise and 255 * sqrt(value). `key` chooses the noise.
cv::Mat ColorImage(const ColorSensorConfig& config, const CameraModel& camera,
                   const cv::Mat& radiance, double gain, std::uint32_t key,
                   const ParallelRunner& runner);

}  // namespace posefusion
