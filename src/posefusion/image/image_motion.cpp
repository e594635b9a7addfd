#include "posefusion/image/image_motion.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace posefusion {
namespace {

constexpr int kCoarseWidth = 160;
constexpr int kMinSide = 64;

}  // namespace

const cv::Mat& ImageMotion::Next(const cv::Mat& grey) {
  const bool follows = grey.size() == size_;
  size_ = grey.size();
  if (grey.cols < kMinSide || grey.rows < kMinSide) {
    motion_px_.release();
    return motion_px_;
  }
  std::swap(before_, now_);
  const int width = std::min(kCoarseWidth, grey.cols);
  cv::resize(grey, now_, {width, grey.rows * width / grey.cols}, 0, 0, cv::INTER_AREA);
  if (!follows) {
    motion_px_.release();
    return motion_px_;
  }
  field_.Estimate(now_, before_, motion_px_);
  motion_px_ *= -static_cast<double>(grey.cols) / width;  // from where it was to where it went
  return motion_px_;
}

}  // namespace posefusion
