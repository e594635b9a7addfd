#pragma once

#include <opencv2/core/mat.hpp>

#include "posefusion/image/camera_model.h"
#include "posefusion/image/people_in_frame.h"
#include "posefusion/image/rgbd_frame.h"

namespace posefusion {

/// Takes the lens distortion out of colour, depth and mask together, so that one pinhole camera
/// holds for all three. The maps are made once, for one camera.
///
/// Rectified images are new memory at each call: those given out before stay as they are, and the
/// input is never changed. For a camera without distortion the very same images are given back.
/// All methods are const and thread-safe.
class Rectifier {
 public:
  /// @throws std::invalid_argument for a camera that fails CameraModel::Check.
  explicit Rectifier(const CameraModel& camera);

  /// Colour by bilinear interpolation, depth by the nearest pixel (a mean of two depths would lie
  /// on no surface). What lies outside the incoming image becomes black with depth 0.
  /// @throws std::invalid_argument when the frame is of another camera or its images do not fit.
  RgbdFrame Rectify(const RgbdFrame& frame) const;

  /// Mask and depth by the nearest pixel; 0 outside. Empty images stay empty.
  /// @throws std::invalid_argument for another type or size.
  PeopleInFrame Rectify(const PeopleInFrame& people) const;

  /// Camera of the images that go in.
  const CameraModel& input_camera() const { return input_camera_; }

  /// Camera of the images that come out: the same pinhole, no distortion.
  const CameraModel& output_camera() const { return output_camera_; }

 private:
  cv::Mat NearestPixels(const cv::Mat& image, int type, const char* what) const;

  CameraModel input_camera_;
  CameraModel output_camera_;
  cv::Mat nearest_map_;        ///< CV_16SC2, pixel of the input; empty without distortion
  cv::Mat bilinear_map_;       ///< CV_16SC2, whole part of the coordinates
  cv::Mat bilinear_fraction_;  ///< CV_16UC1, index of the interpolation weights
};

}  // namespace posefusion
