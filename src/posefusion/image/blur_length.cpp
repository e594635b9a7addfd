#include "posefusion/image/blur_length.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "posefusion/image/sharpness_loss.h"

namespace posefusion {
namespace {

constexpr double kMaxGapS = 0.2;
constexpr double kStillPx = 0.3;    ///< the shortest length that is told from none
constexpr double kUnknownPx = 0.5;  ///< of an image that has none before it
constexpr double kLongestPx = 60;   ///< more cannot be told: nothing fine is left to be lost

// The loss of a length L against a sharp image is kLossScale * ln(1 + (L / kLossLengthPx)^2).
// Lengths below the width of an edge in a sharp image, about 4 px after smoothing, lose little.
// These numbers and the weights below are those of the best recall at 2 % false drops over
// simulated runs of hrp_loop and hrp_falls (14 seeds, 0 to 5 people, evaluate_blur).
constexpr double kLossScale = 0.25;
constexpr double kLossLengthPx = 3.8;

/// How much the loss counts against the motion, as the exponent of its length. The loss counts most
/// when it says more, for it sees what happens between two images.
struct Weight {
  double when_more;
  double when_less;
};
constexpr Weight kForResult{0.87, 0.43};
constexpr Weight kForNext{0.38, 0.27};  ///< less for a knock: an error must not live on

constexpr double kSuddenLoss = 0.4;  ///< of a sharp image that is blurred by 8 px

double LossOf(double length_px) {
  return kLossScale * std::log1p(std::pow(length_px / kLossLengthPx, 2));
}

double LengthOf(double loss) {
  return kLossLengthPx * std::sqrt(std::expm1(std::max(loss, 0.0) / kLossScale));
}

double Between(double from_loss_px, double from_motion_px, const Weight& weight) {
  const double share = from_loss_px > from_motion_px ? weight.when_more : weight.when_less;
  return std::pow(from_loss_px, share) * std::pow(from_motion_px, 1 - share);
}

}  // namespace

BlurEstimate BlurLength::Next(const cv::Mat& grey, StampNs stamp_ns) {
  cv::Mat smooth;
  cv::GaussianBlur(grey, smooth, {3, 3}, 0);
  const bool follows = Follows(grey, stamp_ns);
  const auto shift = motion_.Next(grey);
  BlurEstimate result{kUnknownPx, FineDetail(smooth), false};
  if (follows && shift) {
    const double share = exposure_s_ / SecondsBetween(stamp_ns_, stamp_ns);
    const double loss = SharpnessLoss(smooth_, smooth, shift->shift_px);
    result.length_px = Combine(share * shift->length_px, loss);
    result.is_sudden = loss > kSuddenLoss;
  } else {
    length_px_ = kUnknownPx;
  }
  smooth_ = smooth;
  stamp_ns_ = stamp_ns;
  return result;
}

void BlurLength::Forget() { smooth_.release(); }

bool BlurLength::Follows(const cv::Mat& grey, StampNs stamp_ns) const {
  return smooth_.size() == grey.size() && stamp_ns > stamp_ns_ &&
         SecondsBetween(stamp_ns_, stamp_ns) <= kMaxGapS;
}

double BlurLength::Combine(double moved_px, double loss) {
  const double from_motion_px = std::clamp(moved_px, kStillPx, kLongestPx);
  const double from_loss_px = std::clamp(LengthOf(LossOf(length_px_) + loss), kStillPx, kLongestPx);
  length_px_ = Between(from_loss_px, from_motion_px, kForNext);
  return Between(from_loss_px, from_motion_px, kForResult);
}

}  // namespace posefusion
