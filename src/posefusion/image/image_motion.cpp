#include "posefusion/image/image_motion.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace posefusion {
namespace {

constexpr int kCoarseWidth = 160;
constexpr int kBlockColumns = 8;
constexpr int kBlockRows = 6;
constexpr int kReach = ShiftProposals::kTile / 2 + 2;  ///< pixels, of shifts
constexpr int kSurroundings = 2;                       ///< pixels to either side

cv::Point Whole(const cv::Point2f& shift) { return {cvRound(shift.x), cvRound(shift.y)}; }

/// Sum of the differences of two images (CV_8UC1).
int Difference(const cv::Mat& before, const cv::Mat& now) {
  int sum = 0;
  for (int v = 0; v < now.rows; ++v) {
    const auto* from = before.ptr<std::uint8_t>(v);
    const auto* to = now.ptr<std::uint8_t>(v);
    for (int u = 0; u < now.cols; ++u) sum += std::abs(to[u] - from[u]);
  }
  return sum;
}

/// The image (CV_8UC1) between its pixels; beyond its border as at the border.
float Interpolated(const cv::Mat& image, float u, float v) {
  const float x = std::clamp(u, 0.0F, static_cast<float>(image.cols - 1));
  const float y = std::clamp(v, 0.0F, static_cast<float>(image.rows - 1));
  const int left = std::min(static_cast<int>(x), image.cols - 2);
  const int top = std::min(static_cast<int>(y), image.rows - 2);
  const float a = x - static_cast<float>(left);
  const float b = y - static_cast<float>(top);
  const auto* upper = image.ptr<std::uint8_t>(top) + left;
  const auto* lower = image.ptr<std::uint8_t>(top + 1) + left;
  return (1 - b) * ((1 - a) * static_cast<float>(upper[0]) + a * static_cast<float>(upper[1])) +
         b * ((1 - a) * static_cast<float>(lower[0]) + a * static_cast<float>(lower[1]));
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

void ImageMotion::CollectShifts(const std::vector<cv::Point2f>& proposals) {
  shifts_.assign(1, {0, 0});
  for (const cv::Point2f& proposal : proposals) {
    const auto is_same = [&](const cv::Point2f& shift) { return Whole(shift) == Whole(proposal); };
    if (std::none_of(shifts_.begin(), shifts_.end(), is_same)) shifts_.push_back(proposal);
  }
}

cv::Point2f ImageMotion::BestShift(const cv::Rect& block) const {
  const cv::Mat now = now_(block);
  cv::Point2f best;
  int least = std::numeric_limits<int>::max();
  for (const cv::Point2f& shift : shifts_) {
    const cv::Rect from = block + cv::Point(kReach, kReach) - Whole(shift);
    const int difference = Difference(padded_before_(from), now);
    if (difference >= least) continue;
    least = difference;
    best = shift;
  }
  return best;
}

void ImageMotion::StartFromShifts() {
  cv::copyMakeBorder(before_, padded_before_, kReach, kReach, kReach, kReach, cv::BORDER_REPLICATE);
  motion_px_.create(now_.size(), CV_32FC2);
  for (int row = 0; row < kBlockRows; ++row) {
    for (int column = 0; column < kBlockColumns; ++column) {
      const cv::Rect block(
          {now_.cols * column / kBlockColumns, now_.rows * row / kBlockRows},
          cv::Point(now_.cols * (column + 1) / kBlockColumns, now_.rows * (row + 1) / kBlockRows));
      const cv::Point2f shift = BestShift(block);
      motion_px_(block).setTo(
          cv::Scalar(static_cast<double>(-shift.x), static_cast<double>(-shift.y)));
    }
  }
}

const cv::Mat& ImageMotion::Next(const cv::Mat& grey) {
  const bool follows = grey.size() == size_;
  size_ = grey.size();
  const int width = std::min(kCoarseWidth, grey.cols);
  const int height = grey.rows * width / grey.cols;
  if (width < ShiftProposals::kTile || height < ShiftProposals::kTile) {
    size_ = {};
    motion_px_.release();
    return motion_px_;
  }
  std::swap(before_, now_);
  scale_ = static_cast<float>(grey.cols) / static_cast<float>(width);
  cv::resize(grey, now_, {width, height}, 0, 0, cv::INTER_AREA);
  now_.convertTo(now_f_, CV_32F);
  if (!follows) proposals_.Forget();
  CollectShifts(proposals_.Next(now_f_));
  if (!follows) {
    motion_px_.release();
    return motion_px_;
  }
  StartFromShifts();
  flow_->calc(now_, before_, motion_px_);
  motion_px_ *= static_cast<double>(-scale_);  // from where it was to where it went
  return motion_px_;
}

float ImageMotion::DifferenceAround(cv::Point place, const cv::Vec2f& moved_px) const {
  const cv::Rect area = cv::Rect(0, 0, now_.cols, now_.rows) &
                        cv::Rect(place.x - kSurroundings, place.y - kSurroundings,
                                 2 * kSurroundings + 1, 2 * kSurroundings + 1);
  float sum = 0;
  for (int v = area.y; v < area.y + area.height; ++v) {
    for (int u = area.x; u < area.x + area.width; ++u) {
      const float before = Interpolated(before_, static_cast<float>(u) - moved_px[0] / scale_,
                                        static_cast<float>(v) - moved_px[1] / scale_);
      sum += std::abs(static_cast<float>(now_.at<std::uint8_t>(v, u)) - before);
    }
  }
  return sum / static_cast<float>(area.area());
}

}  // namespace posefusion
