#pragma once

#include "posefusion/image/rgbd_frame.h"
#include "posefusion/simulation/head_motion.h"
#include "posefusion/simulation/renderer.h"
#include "posefusion/simulation/sensor_config.h"

namespace posefusion {

/// One frame as the sensor delivers it, and the truth about it.
struct SensorFrame {
  RgbdFrame frame;             ///< with noise; stamps are the colour and depth times
  cv::Mat labels;              ///< CV_8UC1 at the colour time (middle of the exposure)
  cv::Mat true_depth_m;        ///< exact, at the colour time
  cv::Mat depth_labels;        ///< CV_8UC1 at the depth time
  cv::Mat depth_true_depth_m;  ///< exact, at the depth time
  double blur_length_px = 0;   ///< see TrueBlurLength() in exposure.h
};

/// An Xtion PRO LIVE: takes noise-free views of a world and spoils them as the device does.
/// The same arguments give the same bytes for any number of threads. One owner at a time.
class Sensor {
 public:
  /// `world` must outlive the sensor. @throws std::invalid_argument for a value out of range.
  Sensor(const SensorConfig& config, const World& world);

  /// The frame whose exposure is centred at color_time_s (for rolling shutter: of the middle row).
  /// `frame_index` chooses the noise.
  SensorFrame Capture(const HeadMotion& head, double color_time_s, double depth_time_s,
                      int frame_index, const ParallelRunner& runner);

  const CameraModel& camera() const;

 private:
  SensorConfig config_;
  Renderer renderer_;
};

}  // namespace posefusion
