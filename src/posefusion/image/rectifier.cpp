#include "posefusion/image/rectifier.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

namespace posefusion {
namespace {

cv::Mat Remapped(const cv::Mat& image, const cv::Mat& map, const cv::Mat& fraction, int method) {
  cv::Mat result;
  cv::remap(image, result, map, fraction, method, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  return result;
}

}  // namespace

Rectifier::Rectifier(const CameraModel& camera)
    : input_camera_(camera), output_camera_(camera.Undistorted()) {
  camera.Check("rectifier");
  if (!camera.HasDistortion()) return;
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const cv::Mat distortion(1, 5, CV_64F, input_camera_.distortion.data());
  cv::Mat map_u;
  cv::Mat map_v;
  cv::initUndistortRectifyMap(K, distortion, cv::noArray(), K, {camera.width, camera.height},
                              CV_32FC1, map_u, map_v);
  // cv::remap drops the fraction for nearest-neighbour maps of fixed point, which would be a shift
  // of half a pixel: rounded coordinates are a map of their own.
  cv::Mat unused;
  cv::convertMaps(map_u, map_v, nearest_map_, unused, CV_16SC2, /*nninterpolation=*/true);
  cv::convertMaps(map_u, map_v, bilinear_map_, bilinear_fraction_, CV_16SC2);
}

RgbdFrame Rectifier::Rectify(const RgbdFrame& frame) const {
  CheckFrame(frame, "rectifier");
  if (frame.camera != input_camera_) {
    throw std::invalid_argument(
        "rectifier: the camera of the frame is not the one it was made for");
  }
  RgbdFrame rectified = frame;
  if (nearest_map_.empty()) return rectified;
  rectified.rgb = Remapped(frame.rgb, bilinear_map_, bilinear_fraction_, cv::INTER_LINEAR);
  rectified.depth_m = Remapped(frame.depth_m, nearest_map_, cv::Mat(), cv::INTER_NEAREST);
  rectified.camera = output_camera_;
  return rectified;
}

PeopleInFrame Rectifier::Rectify(const PeopleInFrame& people) const {
  return {NearestPixels(people.mask, CV_8UC1, "mask is not 8UC1"),
          NearestPixels(people.depth_m, CV_32FC1, "depth of people is not 32FC1")};
}

cv::Mat Rectifier::NearestPixels(const cv::Mat& image, int type, const char* what) const {
  if (image.empty()) return image;
  if (image.type() != type || image.cols != input_camera_.width ||
      image.rows != input_camera_.height) {
    throw std::invalid_argument(std::string("rectifier: ") + what + " of the size of the camera");
  }
  if (nearest_map_.empty()) return image;
  return Remapped(image, nearest_map_, cv::Mat(), cv::INTER_NEAREST);
}

}  // namespace posefusion
