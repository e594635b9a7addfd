#pragma once

namespace posefusion {

/// Axial noise of a structured-light depth camera: sigma(z) = base + growth * (z - offset)^2.
/// Source: Nguyen, Izadi, Lovell, "Modeling Kinect Sensor Noise for Improved 3D Reconstruction and
/// Tracking", 3DIMPVT 2012, eq. for sigma_z at small angles; the Xtion has the same sensor.
struct DepthNoiseConfig {
  double base_m = 0.0012;        ///< noise at the offset distance
  double growth_per_m = 0.0019;  ///< growth with the squared distance
  double offset_m = 0.4;         ///< distance of the least noise
};

template <class V>
void Describe(V& v, DepthNoiseConfig& c) {
  v.Field("base_m", c.base_m, 0.0001, 0.1);
  v.Field("growth_per_m", c.growth_per_m, 0.0, 0.1);
  v.Field("offset_m", c.offset_m, 0.0, 2.0);
}

/// Standard deviation in metres of a depth of z metres.
inline float DepthSigma(const DepthNoiseConfig& c, float z_m) {
  const float distance = z_m - static_cast<float>(c.offset_m);
  return static_cast<float>(c.base_m) + static_cast<float>(c.growth_per_m) * distance * distance;
}

}  // namespace posefusion
