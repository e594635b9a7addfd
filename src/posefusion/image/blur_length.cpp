#include "posefusion/image/blur_length.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "posefusion/image/fine_detail.h"
#include "posefusion/image/sharpness.h"

namespace posefusion {
namespace {

constexpr double kMaxGapS = 0.2;
constexpr double kUnknownPx = 0.5;   ///< of an image that has none before it
constexpr int kSampleStride = 4;     ///< pixels of the motion field
constexpr double kSameContrast = 4;  ///< a larger ratio of CoarseContrast is another light
constexpr double kSuddenPx2 = 80;    ///< growth of a sharp image that is blurred by 9 px, and more

// The numbers below were found together as those of the best recall at 1 % false drops over ten
// simulated runs of hrp_loop and hrp_falls (evaluate_blur).

/// Motion between images, taken as motion while the shutter is open: the less it lasts, the less
/// certain. Blur that grows or fades shows a change within the interval.
constexpr double kMotionPx = 0.11;
constexpr double kPerLength = 0.02;
constexpr double kPerChange = 0.115;
constexpr double kPerGrowth = 0.37;
constexpr double kShortPx = 5.2;  ///< shorter blur is as uncertain in its square as this

/// Growth of the blur: what its equations leave out, how much the tiles differ, and noise.
constexpr double kGrowthPx2 = 1.2;
constexpr double kPerSpread = 0.44;
constexpr double kPerError = 13;
constexpr double kPerSize = 0.23;

/// What differs more from the camera's motion has a motion of its own, unless the camera's explains
/// the image clearly better: the flow carries background beside it along. The flow, which is
/// smooth, finds it too short.
constexpr double kOwnMotionPx = 1.9;
constexpr double kOwnMotionPerLength = 0.39;
constexpr float kClearlyBetter = 0.8F;  ///< share of the difference that the own motion leaves
constexpr float kOwnMotionMissingPx = 2.2F;

double Square(double x) { return x * x; }

double SizeOfGrowth(const BlurConsensus& consensus) {
  return std::abs(consensus.growth_xx_px2) + std::abs(consensus.growth_yy_px2);
}

/// What of it is more than the tiles differ.
double SureChange(const BlurConsensus& consensus) {
  return std::max(0.0, SizeOfGrowth(consensus) - consensus.spread_px2);
}

double ClearGrowth(const BlurConsensus& consensus) {
  return consensus.growth_xx_px2 + consensus.growth_yy_px2 - consensus.spread_px2;
}

}  // namespace

BlurLength::Blur BlurLength::Unknown() {
  const double square_px2 = 0.5 * Square(kUnknownPx);
  return {square_px2, square_px2, Square(kGrowthPx2)};
}

bool BlurLength::HasSameContrast(double contrast) {
  const double before = std::exchange(contrast_, contrast);
  return std::max(before, contrast_) <= kSameContrast * std::min(before, contrast_);
}

BlurEstimate BlurLength::Next(const cv::Mat& grey, StampNs stamp_ns) {
  const bool follows = Follows(grey, stamp_ns);
  const double interval_s = SecondsBetween(stamp_ns_, stamp_ns);
  size_ = grey.size();
  stamp_ns_ = stamp_ns;
  std::swap(before_, smooth_);
  SmoothForBlurGrowth(grey, smooth_);
  cv::GaussianBlur(grey, fine_, {3, 3}, 0);
  const cv::Mat& moved_px = image_motion_.Next(grey);
  const double detail = FineDetail(fine_);
  const double contrast = CoarseContrast(grey);
  const bool same_light = HasSameContrast(contrast);
  if (!follows || !same_light || moved_px.empty()) {
    tiles_.clear();
    blur_ = Unknown();
    return {kUnknownPx, detail, false, contrast};
  }
  const double share = exposure_s_ / interval_s;
  std::vector<BlurTile> tiles = MeasureBlurGrowth(before_, smooth_, moved_px);
  const BlurConsensus consensus = FindConsensus(tiles, share, tiles_, share_);
  tiles_ = std::move(tiles);
  share_ = share;
  Grow(consensus);
  Correct(FromMotion(consensus));
  const bool is_sudden = ClearGrowth(consensus) > kSuddenPx2;
  return {MedianLength(share, consensus), detail, is_sudden, contrast};
}

void BlurLength::Forget() { size_ = {}; }

bool BlurLength::Follows(const cv::Mat& grey, StampNs stamp_ns) const {
  return size_ == grey.size() && stamp_ns > stamp_ns_ &&
         SecondsBetween(stamp_ns_, stamp_ns) <= kMaxGapS;
}

BlurLength::Blur BlurLength::FromMotion(const BlurConsensus& consensus) {
  const double length_px = consensus.length_px;
  const cv::Point2d moved_px = consensus.moved_px;
  // The direction is that of the median shift, the length its own median.
  const double scale = Square(length_px) / std::max(moved_px.ddot(moved_px), 1e-6);
  const double deviation_px = kMotionPx + kPerLength * length_px + kPerChange * consensus.change_px;
  return {scale * Square(moved_px.x), scale * Square(moved_px.y),
          Square(2 * std::max(length_px, kShortPx) * deviation_px) +
              Square(kPerGrowth * SureChange(consensus))};
}

void BlurLength::Grow(const BlurConsensus& consensus) {
  blur_.xx_px2 = std::max(blur_.xx_px2 + consensus.growth_xx_px2, 0.0);
  blur_.yy_px2 = std::max(blur_.yy_px2 + consensus.growth_yy_px2, 0.0);
  blur_.variance_px4 += Square(kGrowthPx2) + Square(kPerSpread * consensus.spread_px2) +
                        Square(kPerError * consensus.error_px2) +
                        Square(kPerSize * SizeOfGrowth(consensus));
}

void BlurLength::Correct(const Blur& measured) {
  const double gain = blur_.variance_px4 / (blur_.variance_px4 + measured.variance_px4);
  blur_.xx_px2 += gain * (measured.xx_px2 - blur_.xx_px2);
  blur_.yy_px2 += gain * (measured.yy_px2 - blur_.yy_px2);
  blur_.variance_px4 *= 1 - gain;
}

double BlurLength::MedianLength(double share, const BlurConsensus& consensus) {
  const auto camera_px = static_cast<float>(std::sqrt(std::max(blur_.xx_px2 + blur_.yy_px2, 0.0)));
  const float more_px = camera_px - static_cast<float>(consensus.length_px);
  const double own_px = kOwnMotionPx + kOwnMotionPerLength * consensus.length_px;
  const cv::Vec2f camera_moved_px = cv::Point2f(consensus.moved_px / share);
  const cv::Mat& moved_px = image_motion_.moved_px();
  lengths_px_.clear();
  for (int v = kSampleStride / 2; v < moved_px.rows; v += kSampleStride) {
    for (int u = kSampleStride / 2; u < moved_px.cols; u += kSampleStride) {
      const cv::Vec2f moved = moved_px.at<cv::Vec2f>(v, u);
      const auto length_px = static_cast<float>(share * cv::norm(moved));
      if (share * cv::norm(moved - camera_moved_px) <= own_px) {
        lengths_px_.push_back(std::max(0.0F, length_px + more_px));
      } else if (MovesWithCamera({u, v}, camera_moved_px)) {
        lengths_px_.push_back(camera_px);
      } else {
        lengths_px_.push_back(length_px + kOwnMotionMissingPx);
      }
    }
  }
  const auto middle = lengths_px_.begin() + static_cast<std::ptrdiff_t>(lengths_px_.size() / 2);
  std::nth_element(lengths_px_.begin(), middle, lengths_px_.end());
  return static_cast<double>(*middle);
}

bool BlurLength::MovesWithCamera(cv::Point place, const cv::Vec2f& camera_moved_px) const {
  const auto& moved_px = image_motion_.moved_px().at<cv::Vec2f>(place);
  return image_motion_.DifferenceAround(place, camera_moved_px) <=
         kClearlyBetter * image_motion_.DifferenceAround(place, moved_px);
}

}  // namespace posefusion
