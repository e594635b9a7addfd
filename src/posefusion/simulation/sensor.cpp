#include "posefusion/simulation/sensor.h"

#include "posefusion/common/stamp.h"
#include "posefusion/config/config.h"
#include "posefusion/simulation/color_sensor.h"
#include "posefusion/simulation/depth_sensor.h"
#include "posefusion/simulation/exposure.h"
#include "posefusion/simulation/hash_random.h"

namespace posefusion {
namespace {

SensorConfig Checked(const SensorConfig& config) {
  CheckRanges("sensor", config);
  config.camera.Check("sensor.camera");
  return config;
}

Exposure ExposureAround(const ColorSensorConfig& config, double middle_s) {
  const double readout = config.rolling_shutter ? config.readout_s : 0.0;
  const double half = 0.5 * (config.exposure_s + readout);
  return {middle_s - half, middle_s + half, config.exposure_s, config.max_sub_exposures};
}

}  // namespace

Sensor::Sensor(const SensorConfig& config, const World& world)
    : config_(Checked(config)), renderer_(world) {}

const CameraModel& Sensor::camera() const { return config_.camera; }

SensorFrame Sensor::Capture(const HeadMotion& head, double color_time_s, double depth_time_s,
                            int frame_index, const ParallelRunner& runner) {
  const auto seed = static_cast<std::uint32_t>(config_.seed);
  const auto index = static_cast<std::uint32_t>(frame_index);
  const ExposedView color =
      renderer_.Expose(config_.camera, head, ExposureAround(config_.color, color_time_s), runner);
  const View depth =
      renderer_.RenderDepth(config_.camera, head.T_map_camera(depth_time_s), depth_time_s, runner);
  SensorFrame result;
  result.frame.stamp_ns = StampFromSeconds(color_time_s);
  result.frame.depth_stamp_ns = StampFromSeconds(depth_time_s);
  result.frame.camera = config_.camera;
  result.frame.rgb = ColorImage(config_.color, config_.camera, color.radiance,
                                GainAt(config_.color, config_.seed, color_time_s),
                                HashOf(seed, index, 11), runner);
  result.frame.depth_m =
      DepthImage(config_.depth, config_.camera, depth, HashOf(seed, index, 12), runner);
  result.labels = color.middle.labels;
  result.true_depth_m = color.middle.depth_m;
  result.depth_labels = depth.labels;
  result.depth_true_depth_m = depth.depth_m;
  result.blur_length_px = TrueBlurLength(color.motion_px);
  return result;
}

}  // namespace posefusion
