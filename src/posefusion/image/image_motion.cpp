#include "posefusion/image/image_motion.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace posefusion {
namespace {

constexpr int kCoarseWidth = 160;
constexpr int kBlockColumns = 8;
constexpr int kBlockRows = 6;

/// Mean difference of each block if all content went by `shift_px`.
void DifferenceOfBlocks(const cv::Mat& before, const cv::Mat& now, cv::Point2f shift_px,
                        cv::Mat& difference) {
  const cv::Matx23f move(1, 0, shift_px.x, 0, 1, shift_px.y);
  cv::Mat moved;
  cv::warpAffine(before, moved, move, before.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  cv::absdiff(now, moved, moved);
  cv::resize(moved, difference, {kBlockColumns, kBlockRows}, 0, 0, cv::INTER_AREA);
}

}  // namespace

ImageMotion::ImageMotion()
    : flow_(cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_ULTRAFAST)) {
  // Propagation goes through stripes of the image whose number depends on the number of threads.
  flow_->setUseSpatialPropagation(false);
  flow_->setFinestScale(1);
  flow_->setPatchStride(3);
  flow_->setGradientDescentIterations(16);
}

void ImageMotion::StartFromShifts(const std::vector<cv::Point2f>& proposals) {
  cv::Mat least;
  cv::Mat difference;
  cv::Mat best(kBlockRows, kBlockColumns, CV_32FC2, cv::Scalar(0, 0));
  DifferenceOfBlocks(before_f_, now_f_, {0, 0}, least);
  for (const cv::Point2f& shift_px : proposals) {
    DifferenceOfBlocks(before_f_, now_f_, shift_px, difference);
    const cv::Scalar back(static_cast<double>(-shift_px.x), static_cast<double>(-shift_px.y));
    best.setTo(back, difference < least);
    least = cv::min(least, difference);
  }
  cv::resize(best, motion_px_, now_.size(), 0, 0, cv::INTER_NEAREST);
}

const cv::Mat& ImageMotion::Next(const cv::Mat& grey) {
  const bool follows = grey.size() == size_;
  size_ = grey.size();
  if (grey.cols < ShiftProposals::kTile || grey.rows < ShiftProposals::kTile) {
    size_ = {};
    motion_px_.release();
    return motion_px_;
  }
  std::swap(before_, now_);
  std::swap(before_f_, now_f_);
  const int width = std::min(kCoarseWidth, grey.cols);
  cv::resize(grey, now_, {width, grey.rows * width / grey.cols}, 0, 0, cv::INTER_AREA);
  now_.convertTo(now_f_, CV_32F);
  if (!follows) proposals_.Forget();
  const auto& shifts = proposals_.Next(now_f_);
  if (!follows) {
    motion_px_.release();
    return motion_px_;
  }
  StartFromShifts(shifts);
  flow_->calc(now_, before_, motion_px_);
  motion_px_ *= -static_cast<double>(grey.cols) / width;  // from where it was to where it went
  return motion_px_;
}

}  // namespace posefusion
