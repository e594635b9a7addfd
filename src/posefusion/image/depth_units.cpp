#include "posefusion/image/depth_units.h"

#include <cstdint>
#include <limits>
#include <stdexcept>

namespace posefusion {
namespace {

void ConvertRow(const std::uint16_t* raw, int width, float units_per_metre, float* metres) {
  for (int u = 0; u < width; ++u) metres[u] = static_cast<float>(raw[u]) / units_per_metre;
}

void ConvertRow(const float* raw, int width, float* metres) {
  for (int u = 0; u < width; ++u) {
    // Both comparisons are false for NaN.
    const bool valid = raw[u] > 0 && raw[u] <= std::numeric_limits<float>::max();
    metres[u] = valid ? raw[u] : 0.0F;
  }
}

}  // namespace

cv::Mat DepthToMetres(const cv::Mat& depth, const std::string& source, double units_per_metre) {
  if (!(units_per_metre > 0 && units_per_metre <= std::numeric_limits<float>::max())) {
    throw std::invalid_argument(source + ": depth units per metre are " +
                                std::to_string(units_per_metre) + ", not positive");
  }
  if (depth.type() != CV_16UC1 && depth.type() != CV_32FC1) {
    throw std::invalid_argument(source + ": depth of type " + cv::typeToString(depth.type()) +
                                ", expected 16UC1 or 32FC1");
  }
  cv::Mat depth_m(depth.size(), CV_32FC1);
  for (int v = 0; v < depth.rows; ++v) {
    if (depth.type() == CV_16UC1) {
      ConvertRow(depth.ptr<std::uint16_t>(v), depth.cols, static_cast<float>(units_per_metre),
                 depth_m.ptr<float>(v));
    } else {
      ConvertRow(depth.ptr<float>(v), depth.cols, depth_m.ptr<float>(v));
    }
  }
  return depth_m;
}

}  // namespace posefusion
