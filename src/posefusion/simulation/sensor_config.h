#pragma once

#include "posefusion/image/camera_model.h"
#include "posefusion/image/depth_noise.h"

namespace posefusion {

/// Colour side of the sensor. Noise: photon (shot) noise grows with the square root of the signal,
/// read noise does not depend on it; EMVA Standard 1288, release 3.1, eq. 12.
struct ColorSensorConfig {
  double exposure_s = 0.012;          ///< time that the shutter is open
  bool rolling_shutter = false;       ///< rows are exposed one after the other
  double readout_s = 0.024;           ///< from the first to the last row
  int max_sub_exposures = 24;         ///< views averaged where the image moves fast
  double full_well_electrons = 9000;  ///< electrons of a white pixel: sets the shot noise
  double read_noise_electrons = 18;   ///< standard deviation in darkness
  double gain_drift = 0.04;           ///< amplitude of the automatic gain's slow drift
  double gain_drift_period_s = 17;    ///< of its slowest wave
  double vignetting = 0.22;           ///< loss of light in the corners
  double lens_blur_px = 0.5;          ///< standard deviation of lens and demosaicing
};

/// Depth side. Sources stand where the models are applied, in depth_sensor.h.
struct DepthSensorConfig {
  DepthNoiseConfig axial;            ///< axial noise
  double lateral_noise_px = 0.8;     ///< standard deviation of edges, in pixels
  double disparity_step_px = 0.125;  ///< disparity is a multiple of this
  double baseline_m = 0.075;         ///< between infrared camera and projector
  double min_range_m = 0.5;
  double max_range_m = 6.0;
  double grazing_cosine = 0.12;  ///< surfaces flatter than this return nothing
  double dark_reflectance =
      0.05;  ///< infrared reflectance at which half of the pixels fail at 2.5 m
};

struct SensorConfig {
  CameraModel camera{640, 480, 525.0, 525.0, 319.5, 239.5, {}};
  int seed = 1;  ///< of all noise
  ColorSensorConfig color;
  DepthSensorConfig depth;
};

template <class V>
void Describe(V& v, ColorSensorConfig& c) {
  v.Field("exposure_s", c.exposure_s, 0.0, 0.033);
  v.Field("rolling_shutter", c.rolling_shutter);
  v.Field("readout_s", c.readout_s, 0.0, 0.033);
  v.Field("max_sub_exposures", c.max_sub_exposures, 1, 64);
  v.Field("full_well_electrons", c.full_well_electrons, 100.0, 1e6);
  v.Field("read_noise_electrons", c.read_noise_electrons, 0.0, 1e4);
  v.Field("gain_drift", c.gain_drift, 0.0, 0.5);
  v.Field("gain_drift_period_s", c.gain_drift_period_s, 0.1, 1e4);
  v.Field("vignetting", c.vignetting, 0.0, 0.9);
  v.Field("lens_blur_px", c.lens_blur_px, 0.0, 2.0);
}

template <class V>
void Describe(V& v, DepthSensorConfig& c) {
  v.Group("axial", c.axial);
  v.Field("lateral_noise_px", c.lateral_noise_px, 0.0, 5.0);
  v.Field("disparity_step_px", c.disparity_step_px, 0.0, 1.0);
  v.Field("baseline_m", c.baseline_m, 0.0, 0.3);
  v.Field("min_range_m", c.min_range_m, 0.0, 2.0);
  v.Field("max_range_m", c.max_range_m, 1.0, 20.0);
  v.Field("grazing_cosine", c.grazing_cosine, 0.0, 0.9);
  v.Field("dark_reflectance", c.dark_reflectance, 0.0, 1.0);
}

template <class V>
void Describe(V& v, SensorConfig& c) {
  v.Field("seed", c.seed, 0, 1 << 30);
  v.Group("color", c.color);
  v.Group("depth", c.depth);
}

}  // namespace posefusion
