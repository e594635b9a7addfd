#include "posefusion/image/blur_length.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "posefusion/image/fine_detail.h"

namespace posefusion {
namespace {

constexpr double kMaxGapS = 0.2;
constexpr double kUnknownPx = 0.5;  ///< of an image that has none before it
constexpr int kSampleStride = 4;    ///< pixels of the motion field
constexpr double kSuddenPx2 = 60;  ///< growth of a sharp image that is blurred by 8 px, and more

/// Content that seems to come from further than this share of the image's width has no match: it
/// moved fast or has no texture. It counts as blurred.
constexpr double kReach = 0.25;
constexpr double kUnmatchedPx = 8;

// The numbers below were found together as those of the best recall at 1 % false drops over twelve
// simulated runs of hrp_loop and hrp_falls (evaluate_blur); half as much more or less of one of
// them changes little.

/// Motion between images, taken as motion while the shutter is open: the less it lasts, the less
/// certain. Blur that grows or fades shows a change within the interval.
constexpr double kMotionPx = 0.1;
constexpr double kPerLength = 0.05;
constexpr double kPerChange = 0.2;
constexpr double kPerGrowth = 0.4;
constexpr double kShortPx = 1;  ///< shorter blur is as uncertain in its square as this

/// Growth of the blur: what its equations leave out, how much the tiles differ, and noise.
constexpr double kGrowthScale = 0.8;
constexpr double kGrowthPx2 = 1.7;
constexpr double kPerSpread = 0.9;
constexpr double kPerError = 4;
constexpr double kPerSize = 0.2;

/// What differs more from the camera's motion has a motion of its own.
constexpr double kOwnMotionPx = 1.2;
constexpr double kOwnMotionPerLength = 0.3;

double Square(double x) { return x * x; }

double SizeOfGrowth(const BlurConsensus& consensus) {
  return kGrowthScale * (std::abs(consensus.growth_xx_px2) + std::abs(consensus.growth_yy_px2));
}

/// What of it is more than the tiles differ.
double SureChange(const BlurConsensus& consensus) {
  return std::max(0.0, SizeOfGrowth(consensus) - consensus.spread_px2);
}

double ClearGrowth(const BlurConsensus& consensus) {
  return kGrowthScale * (consensus.growth_xx_px2 + consensus.growth_yy_px2) - consensus.spread_px2;
}

}  // namespace

BlurLength::Blur BlurLength::Unknown() {
  const double square_px2 = 0.5 * Square(kUnknownPx);
  return {square_px2, square_px2, Square(kGrowthPx2)};
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
  if (!follows || moved_px.empty()) {
    tiles_.clear();
    blur_ = Unknown();
    return {kUnknownPx, detail, false};
  }
  const double share = exposure_s_ / interval_s;
  std::vector<BlurTile> tiles = MeasureBlurGrowth(before_, smooth_, moved_px);
  const BlurConsensus consensus = FindConsensus(tiles, share, tiles_, share_);
  tiles_ = std::move(tiles);
  share_ = share;
  Grow(consensus);
  Correct(FromMotion(consensus));
  const bool is_sudden = ClearGrowth(consensus) > kSuddenPx2;
  return {MedianLength(moved_px, share, consensus), detail, is_sudden};
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
  blur_.xx_px2 = std::max(blur_.xx_px2 + kGrowthScale * consensus.growth_xx_px2, 0.0);
  blur_.yy_px2 = std::max(blur_.yy_px2 + kGrowthScale * consensus.growth_yy_px2, 0.0);
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

double BlurLength::MedianLength(const cv::Mat& moved_px, double share,
                                const BlurConsensus& consensus) {
  const double camera_px = std::sqrt(std::max(blur_.xx_px2 + blur_.yy_px2, 0.0));
  const auto more_px = static_cast<float>(camera_px - consensus.length_px);
  const auto own_px = static_cast<float>(kOwnMotionPx + kOwnMotionPerLength * consensus.length_px);
  const cv::Vec2f camera_motion_px(static_cast<float>(consensus.moved_px.x),
                                   static_cast<float>(consensus.moved_px.y));
  const auto reach_px = static_cast<float>(kReach * size_.width * share);
  const auto unmatched_px = static_cast<float>(std::max(kUnmatchedPx, camera_px));
  lengths_px_.clear();
  for (int v = kSampleStride / 2; v < moved_px.rows; v += kSampleStride) {
    for (int u = kSampleStride / 2; u < moved_px.cols; u += kSampleStride) {
      const cv::Vec2f motion_px = static_cast<float>(share) * moved_px.at<cv::Vec2f>(v, u);
      const cv::Vec2f own = motion_px - camera_motion_px;
      float length_px = std::hypot(motion_px[0], motion_px[1]);
      if (length_px > reach_px) {
        length_px = unmatched_px;
      } else if (own.dot(own) <= own_px * own_px) {
        length_px = std::max(0.0F, length_px + more_px);
      }
      lengths_px_.push_back(length_px);
    }
  }
  const auto middle = lengths_px_.begin() + static_cast<std::ptrdiff_t>(lengths_px_.size() / 2);
  std::nth_element(lengths_px_.begin(), middle, lengths_px_.end());
  return static_cast<double>(*middle);
}

}  // namespace posefusion
