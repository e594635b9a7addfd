#include "posefusion_ros/bag_writer.h"

#include <rosbag/bag.h>
#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/image_encodings.h>

#include <filesystem>
#include <limits>
#include <stdexcept>

#include "posefusion_ros/conversions.h"
#include "posefusion_ros/topic_names.h"

namespace posefusion {
namespace {

sensor_msgs::Image DepthMessage(const cv::Mat& depth_m, const std_msgs::Header& header) {
  sensor_msgs::Image image;
  image.header = header;
  image.width = static_cast<std::uint32_t>(depth_m.cols);
  image.height = static_cast<std::uint32_t>(depth_m.rows);
  image.encoding = sensor_msgs::image_encodings::TYPE_32FC1;
  image.step = image.width * static_cast<std::uint32_t>(sizeof(float));
  image.data.resize(static_cast<std::size_t>(image.step) * image.height);
  cv::Mat pixels(depth_m.rows, depth_m.cols, CV_32FC1, image.data.data());
  depth_m.copyTo(pixels);
  pixels.setTo(std::numeric_limits<float>::quiet_NaN(), depth_m == 0);
  return image;
}

sensor_msgs::CameraInfo InfoMessage(const CameraModel& camera, const std_msgs::Header& header) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info.D.assign(camera.distortion.begin(), camera.distortion.end());
  info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  return info;
}

}  // namespace

struct BagWriter::State {
  std::string path;
  std::string temporary_path;
  std::string camera_frame;
  rosbag::Bag bag;
  bool complete = false;

  /// Runs a step of writing; its errors name the bag.
  template <class Step>
  void Guarded(const Step& step) {
    try {
      step();
    } catch (const std::exception& error) {
      throw std::runtime_error(path + ": cannot be written: " + error.what());
    }
  }
};

BagWriter::BagWriter(const std::string& path, const std::string& camera_frame)
    : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->temporary_path = path + ".tmp";
  state_->camera_frame = camera_frame;
  state_->Guarded([&] { state_->bag.open(state_->temporary_path, rosbag::bagmode::Write); });
}

BagWriter::~BagWriter() {
  if (state_->complete) return;
  try {
    state_->bag.close();
  } catch (const std::exception&) {  // a full disk; the file goes anyway
  }
  std::error_code ignored;
  std::filesystem::remove(state_->temporary_path, ignored);
}

void BagWriter::Write(const RgbdFrame& frame) {
  std_msgs::Header header;
  header.frame_id = state_->camera_frame;
  header.stamp = ToRosTime(frame.depth_stamp_ns);
  state_->Guarded([&] {
    const auto write = [&](const char* topic, const auto& message) {
      state_->bag.write(std::string("/") + topic, message.header.stamp, message);
    };
    write(kCameraDepthTopic, DepthMessage(frame.depth_m, header));
    header.stamp = ToRosTime(frame.stamp_ns);
    write(kCameraInfoTopic, InfoMessage(frame.camera, header));
    write(kCameraRgbTopic, *ToRgb8Message(frame.rgb, header));
  });
}

void BagWriter::Close() {
  state_->Guarded([&] {
    state_->bag.close();
    std::filesystem::rename(state_->temporary_path, state_->path);
  });
  state_->complete = true;
}

}  // namespace posefusion
