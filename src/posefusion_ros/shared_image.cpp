#include "posefusion_ros/shared_image.h"

#include <stdexcept>

namespace posefusion {
namespace {

/// Lets OpenCV's reference counting release a message.
class MessageHolder : public cv::MatAllocator {
 public:
  cv::UMatData* Hold(const sensor_msgs::ImageConstPtr& image, std::uint8_t* pixels) const {
    auto* data = new cv::UMatData(this);
    data->data = data->origdata = pixels;
    data->size = image->data.size();
    data->userdata = new sensor_msgs::ImageConstPtr(image);
    data->refcount = 1;
    return data;
  }

  cv::UMatData* allocate(int dims, const int* sizes, int type, void* pixels, std::size_t* step,
                         cv::AccessFlag flags, cv::UMatUsageFlags usage) const override {
    return cv::Mat::getStdAllocator()->allocate(dims, sizes, type, pixels, step, flags, usage);
  }
  bool allocate(cv::UMatData*, cv::AccessFlag, cv::UMatUsageFlags) const override { return false; }

  void deallocate(cv::UMatData* data) const override {
    delete static_cast<sensor_msgs::ImageConstPtr*>(data->userdata);
    delete data;
  }
};

const MessageHolder& Holder() {
  static const MessageHolder* const holder = new MessageHolder;  // outlives every static image
  return *holder;
}

void CheckBytes(const sensor_msgs::Image& image, int type, const std::string& topic) {
  const std::string size = std::to_string(image.width) + "x" + std::to_string(image.height);
  if (image.width == 0 || image.height == 0) {
    throw std::invalid_argument(topic + ": image of size " + size);
  }
  const std::size_t row_bytes = static_cast<std::size_t>(image.width) * CV_ELEM_SIZE(type);
  const std::size_t need = static_cast<std::size_t>(image.step) * (image.height - 1) + row_bytes;
  const bool aligned = image.step % CV_ELEM_SIZE1(type) == 0;
  if (aligned && image.step >= row_bytes && image.data.size() >= need) return;
  throw std::invalid_argument(topic + ": torn image, " + std::to_string(image.data.size()) +
                              " bytes with rows of " + std::to_string(image.step) + " make no " +
                              image.encoding + " of size " + size);
}

}  // namespace

cv::Mat ShareImage(const sensor_msgs::ImageConstPtr& image, int type, const std::string& topic) {
  CheckBytes(*image, type, topic);
  auto* pixels = const_cast<std::uint8_t*>(image->data.data());  // cv::Mat knows no const pixels
  cv::Mat mat(static_cast<int>(image->height), static_cast<int>(image->width), type, pixels,
              image->step);
  mat.u = Holder().Hold(image, pixels);
  return mat;
}

}  // namespace posefusion
