#pragma once

namespace posefusion {

/// What has to be known of the messages on camera_info, for everybody who reads them.
struct CameraInfoConfig {
  /// By the driver, though camera_info has the distortion of the raw images: P is used, not K and
  /// D.
  bool images_are_rectified = false;
};

template <class V>
void Describe(V& v, CameraInfoConfig& c) {
  v.Field("images_are_rectified", c.images_are_rectified);
}

}  // namespace posefusion
