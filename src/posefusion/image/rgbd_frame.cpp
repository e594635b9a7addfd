#include "posefusion/image/rgbd_frame.h"

#include <stdexcept>

namespace posefusion {
namespace {

std::string SizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

void CheckSize(const cv::Mat& image, const CameraModel& camera, const std::string& name) {
  if (image.cols == camera.width && image.rows == camera.height) return;
  throw std::invalid_argument(name + " has " + SizeText(image.cols, image.rows) +
                              " pixels, the camera " + SizeText(camera.width, camera.height));
}

}  // namespace

void CheckFrame(const RgbdFrame& frame, const std::string& source) {
  if (frame.rgb.type() != CV_8UC3) throw std::invalid_argument(source + ": colour is not 8UC3");
  if (frame.depth_m.type() != CV_32FC1)
    throw std::invalid_argument(source + ": depth is not 32FC1");
  frame.camera.Check(source);
  CheckSize(frame.rgb, frame.camera, source + ": colour");
  CheckSize(frame.depth_m, frame.camera, source + ": depth");
}

void CheckFollows(StampNs stamp_ns, const std::optional<StampNs>& last_ns) {
  if (!last_ns || stamp_ns > *last_ns) return;
  throw std::invalid_argument("stamp " + FormatStamp(stamp_ns) + " does not follow " +
                              FormatStamp(*last_ns));
}

}  // namespace posefusion
